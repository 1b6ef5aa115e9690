// Triangles with depths, and the exact depths of their pixels in rational arithmetic.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>

#include "framebuffer/format.h"
#include "tests/raster/random_triangles.h"

namespace tessera::test {
using namespace detail;

/// Depths are integer multiples of 2^-40, so that all derived values are exact.
inline constexpr int kDepthFraction = 40;

struct DepthTriangle {
  Triangle corners;
  std::array<std::int64_t, 3> z{};  ///< times 2^40
  double depth(int k) const {
    return std::ldexp(static_cast<double>(z[static_cast<std::size_t>(k)]), -kDepthFraction);
  }
};

/// Depth word of a vertex (WindowVertex::z), with the fraction rounded down.
inline std::uint32_t vertex_depth_word(DepthFormat kind, double z) {
  if (kind == DepthFormat::float32) return quantize_depth(kind, z);
  const int bits = depth_bits(kind);
  return static_cast<std::uint32_t>(static_cast<std::uint64_t>(
      std::floor((z * (std::ldexp(1.0, bits) - 1) + 0.5) * std::ldexp(1.0, 32 - bits))));
}

inline void set_words(DepthTriangle& t, DepthFormat kind) {
  for (int k = 0; k < 3; ++k) t.corners[static_cast<std::size_t>(k)].z = vertex_depth_word(kind, t.depth(k));
}

inline DepthTriangle with_random_depths(RandomTriangles& source, const Triangle& corners) {
  DepthTriangle t{corners, {}};
  constexpr std::int64_t kOne = std::int64_t{1} << kDepthFraction;
  for (std::int64_t& z : t.z) {
    switch (source.between(0, 5)) {
      case 0: z = 0; break;
      case 1: z = kOne; break;
      case 2: z = t.z[0]; break;
      default: z = static_cast<std::int64_t>(source.unit() * static_cast<double>(kOne)); break;
    }
  }
  if (source.between(0, 3) == 0)  // nearly parallel to the screen
    for (std::size_t k = 1; k < 3; ++k)
      t.z[k] = std::clamp<std::int64_t>(t.z[0] + source.between(-100000, 100000), 0, kOne);
  return t;
}

/// Numerator of the depth at a pixel's centre; the denominator is area * 2^40.
inline Exact depth_numerator(const TriangleReference& reference, const DepthTriangle& t, int x, int y) {
  Exact sum = 0;
  for (std::size_t k = 0; k < 3; ++k) sum += reference.edge[k].at(x, y) * t.z[k];
  return sum;
}
/// Stored level floor(z (2^b - 1) + 1/2), exactly.
inline std::int64_t exact_level(const TriangleReference& reference, const DepthTriangle& t, DepthFormat kind,
                                int x, int y) {
  const Exact levels = (Exact{1} << depth_bits(kind)) - 1;
  const Exact denominator = reference.area << kDepthFraction;
  return static_cast<std::int64_t>((2 * depth_numerator(reference, t, x, y) * levels + denominator) /
                                   (2 * denominator));
}
inline long double exact_depth(const TriangleReference& reference, const DepthTriangle& t, int x, int y) {
  return static_cast<long double>(depth_numerator(reference, t, x, y)) /
         static_cast<long double>(reference.area) * 0x1p-40L;
}

inline const char* name_of(DepthFormat kind) {
  switch (kind) {
    case DepthFormat::unorm16: return "unorm16";
    case DepthFormat::unorm24: return "unorm24";
    case DepthFormat::unorm32: return "unorm32";
    default: return "float32";
  }
}
inline constexpr DepthFormat kUnormKinds[] = {DepthFormat::unorm16, DepthFormat::unorm24,
                                              DepthFormat::unorm32};
inline constexpr DepthFormat kDepthKinds[] = {DepthFormat::unorm16, DepthFormat::unorm24,
                                              DepthFormat::unorm32, DepthFormat::float32};

}  // namespace tessera::test
