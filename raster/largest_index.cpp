#include "raster/largest_index.h"

#include <algorithm>

namespace tessera {
namespace {

// Several maxima side by side, which become lanes.
template <class Index>
Index largest(std::span<const Index> indices) {
  constexpr std::size_t kApart = 64 / sizeof(Index);
  Index most[kApart] = {};
  std::size_t i = 0;
  for (; i + kApart <= indices.size(); i += kApart)
    for (std::size_t k = 0; k < kApart; ++k) most[k] = std::max(most[k], indices[i + k]);
  for (; i < indices.size(); ++i) most[0] = std::max(most[0], indices[i]);
  return *std::max_element(most, most + kApart);
}

}  // namespace

std::uint32_t largest_index(std::span<const std::uint32_t> indices) { return largest(indices); }
std::uint16_t largest_index(std::span<const std::uint16_t> indices) { return largest(indices); }

}  // namespace tessera
