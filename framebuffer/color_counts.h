// The colours of one or more pictures, and how often they occur.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "framebuffer/palette.h"

namespace tessera::detail {

struct WeightedColor {
  Rgb8 color;
  std::uint64_t pixels = 0;
};

/// Exact counts of 24-bit colours. Functions throw std::bad_alloc only.
class ColorCounts {
 public:
  /// Counts the pixels of a picture.
  /// @param words  R:G:B, 8 bits each, blue lowest; the upper 8 bits are ignored
  void add(std::span<const std::uint32_t> words);
  bool empty() const noexcept { return counts_.empty(); }

  /// All colours, in a fixed order.
  std::vector<WeightedColor> all() const;
  /// At most `max_colors` colours: all of them, or else the means of cells. A cell has the colours that agree
  /// in the upper b bits of each component, for the largest b that gives few enough cells.
  /// @param max_colors  8 or more
  std::vector<WeightedColor> at_most(std::size_t max_colors) const;

  /// A colour as a position on the Z-order curve: bit i of r, g and b is bit 3i + 2, 3i + 1 and 3i. The cells
  /// of an octree are then ranges.
  struct Count {
    std::uint32_t position = 0;
    std::uint64_t pixels = 0;
  };

 private:
  std::vector<Count> counts_;  ///< ordered by position
};

}  // namespace tessera::detail
