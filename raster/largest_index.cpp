#include "raster/largest_index.h"

#include <algorithm>

namespace tessera::detail {
namespace {

// Independent accumulators, so that the loop vectorizes.
template <class Index>
Index largest(std::span<const Index> indices) {
  constexpr std::size_t kAccumulators = 64 / sizeof(Index);
  Index largest_of[kAccumulators] = {};
  std::size_t i = 0;
  for (; i + kAccumulators <= indices.size(); i += kAccumulators)
    for (std::size_t k = 0; k < kAccumulators; ++k) largest_of[k] = std::max(largest_of[k], indices[i + k]);
  for (; i < indices.size(); ++i) largest_of[0] = std::max(largest_of[0], indices[i]);
  return *std::max_element(largest_of, largest_of + kAccumulators);
}

}  // namespace

std::uint32_t largest_index(std::span<const std::uint32_t> indices) { return largest(indices); }
std::uint16_t largest_index(std::span<const std::uint16_t> indices) { return largest(indices); }

}  // namespace tessera::detail
