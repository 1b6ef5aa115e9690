// Work on several draws, cut into tasks.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace tessera {

/// Vertices or elements [first, last) of a draw.
struct DrawRange {
  std::size_t draw, first, last;
};

/// Adds `count` of a draw, as many as `each` at a time.
inline void cut_into_ranges(std::size_t draw, std::size_t count, std::size_t each, std::vector<DrawRange>& ranges) {
  for (std::size_t first = 0; first < count; first += each) ranges.push_back({draw, first, std::min(count, first + each)});
}

}  // namespace tessera
