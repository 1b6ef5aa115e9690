// Palettes that follow an animation: entries keep their indices and move little from frame to frame.
#pragma once

#include <cstdint>
#include <vector>

#include "framebuffer/adaptive_palette.h"
#include "framebuffer/converter_colors.h"

namespace tessera::detail {

/// Greatest distance in OKLab that an entry moves between two frames, with 6 bits per component or more.
inline constexpr double kMaxEntryMove = 0.02;

/// Entries that follow the colours of successive pictures.
class SmoothEntries {
 public:
  SmoothEntries(const PaletteShape& shape, InstructionSet isa);

  /// Adapts the entries to the next picture: k-means from the present entries gives each its goal, and it
  /// moves towards that.
  /// - The first picture gets its adaptive palette, repeated if it has fewer colours than entries.
  /// - Converters of 6 bits and more: an entry moves at most kMaxEntryMove. It stays if the converter's next
  ///   colour is further away.
  /// - Coarser ones: at most one component of an entry changes, by one level.
  /// - Throws std::bad_alloc only.
  /// @param picture  not empty
  /// @return as many entries as asked for, in the same order for all pictures
  const std::vector<Rgb8>& follow(const ColorCounts& picture);

 private:
  void start(const ColorCounts& picture);
  std::vector<Oklab> goals(const ColorCounts& picture) const;
  Rgb8 moved(Rgb8 entry, const Oklab& goal);
  ConverterLevels walk(const ConverterLevels& from, const Oklab& goal) const;

  PaletteShape shape_;
  InstructionSet isa_;
  ConverterColors converter_;
  std::vector<Rgb8> entries_;
  std::vector<std::uint16_t> uses_;  ///< number of entries per colour of the converter
};

}  // namespace tessera::detail
