// Samples functions of one float at a fraction of all floats; at every float if TESSERA_LONG is set.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <functional>
#include <vector>

#include "shading/lighting.h"
#include "tests/raster/random_triangles.h"

namespace tessera::test {
using namespace detail;

/// |found - exact| in units in the last place (ulp) of `exact`, a double or a long double within the normal
/// range of doubles.
template <class Real>
Real ulps(float found, Real exact) {
  const Real size = std::abs(exact);
  const auto rounded = static_cast<double>(size);
  const std::uint64_t cut_off = std::bit_cast<std::uint64_t>(rounded) - (rounded > size ? 1 : 0);
  const int exponent = std::max(static_cast<int>(cut_off >> 52) - 1023, -126);
  return std::abs(found - exact) *
         std::bit_cast<double>(static_cast<std::uint64_t>(1023 + 23 - exponent) << 52);
}

inline std::uint32_t bits_of(float f) { return std::bit_cast<std::uint32_t>(f); }

inline constexpr std::uint32_t kSampled = 2039;           // a prime, so that all mantissa bits vary
inline constexpr std::size_t kFloatBatch = kBatchPoints;  // floats per kernel call
inline constexpr std::size_t kFloatChunk = 65536;
static_assert(kFloatChunk % kFloatBatch == 0);

/// Calls with whole batches of the floats from the bits `first` to `last`, one in `step` (2039: about 4100
/// per exponent, evenly spaced), every float in long runs.
inline void for_floats(std::uint32_t first, std::uint32_t last,
                       const std::function<void(const std::vector<float>&)>& chunk,
                       std::uint32_t step = kSampled) {
  if (long_tests()) step = 1;
  std::vector<float> floats;
  const auto run = [&] {
    while (floats.size() % kFloatBatch != 0) floats.push_back(floats.back());
    chunk(floats);
    floats.clear();
  };
  for (std::uint64_t bits = first; bits <= last; bits += step) {
    floats.push_back(std::bit_cast<float>(static_cast<std::uint32_t>(bits)));
    if (floats.size() == kFloatChunk) run();
  }
  floats.push_back(std::bit_cast<float>(last));
  run();
}

}  // namespace tessera::test
