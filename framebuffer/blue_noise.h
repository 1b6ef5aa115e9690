// Blue noise by the void-and-cluster method (R. Ulichney, The void-and-cluster method for dither array
// generation, Human Vision, Visual Processing, and Digital Display IV, 1993).
#pragma once

#include <array>
#include <cstdint>

namespace tessera::detail {

inline constexpr int kBlueNoiseSize = 64;  ///< width and height of the array
inline constexpr int kBlueNoisePixels = kBlueNoiseSize * kBlueNoiseSize;

/// A dither array, row by row. Each rank 0 .. kBlueNoisePixels - 1 occurs once, and the ranks below any limit
/// lie evenly, on a torus too.
/// - Computed on the first call, about 20 ms, with the same result on every machine. Thread-safe.
const std::array<std::uint16_t, kBlueNoisePixels>& blue_noise_ranks();

}  // namespace tessera::detail
