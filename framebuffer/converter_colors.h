// The colours that a palette entry may have: each component is a level of a digital-to-analogue converter.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>

#include "framebuffer/oklab.h"
#include "framebuffer/palette.h"

namespace tessera::detail {

/// Levels of r, g and b, each 0 to 2^bits - 1.
using ConverterLevels = std::array<int, 3>;

/// A converter of 1 to 8 bits per component. It shows level v as round(255 v / (2^bits - 1)).
class ConverterColors {
 public:
  explicit ConverterColors(int bits) noexcept;

  int bits() const noexcept { return bits_; }
  /// Number of the colours that it shows.
  std::size_t size() const noexcept { return std::size_t{1} << (3 * bits_); }
  /// Position of a colour, from 0 to size() - 1.
  std::size_t position(const ConverterLevels& levels) const noexcept;

  Rgb8 shown(const ConverterLevels& levels) const noexcept;
  /// The levels whose shown components are nearest to the stored ones.
  ConverterLevels levels_of(Rgb8 color) const noexcept;

  /// The levels of a colour near `target` in OKLab: none of the 26 neighbours of the result is nearer.
  ConverterLevels nearest(const Oklab& target) const noexcept;

  /// The best of the neighbours of `from` whose levels differ by at most 1.
  /// - Best: nearest to `target` in OKLab and nearer than `from`; `from` itself if there is none.
  /// @param max_components  1 to 3: how many levels may differ
  /// @param allowed         whether a neighbour may be chosen
  ConverterLevels step(const ConverterLevels& from, const Oklab& target, int max_components,
                       const std::function<bool(const ConverterLevels&)>& allowed) const;

 private:
  int bits_;
  int max_level_;
};

}  // namespace tessera::detail
