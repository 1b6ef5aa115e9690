// The scalar twin of interpolate-inl.h and of the set-up of weights, and their specification: one pixel of
// one triangle. Edges are exact integers of 128 bits; floats are computed in the kernel's order. The sum of
// the weights is never 0 for a triangle; the kernel handles that case for lines.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "raster/coverage_reference.h"
#include "raster/triangle_setup.h"

namespace tessera::detail {

/// Barycentric coordinates of vertices 1 and 2.
struct BarycentricReference {
  float b1 = 0, b2 = 0;
  float interpolate(float at_first, float at_second, float at_third) const {
    return std::fma(b1, at_second - at_first, std::fma(b2, at_third - at_first, at_first));
  }
};

inline BarycentricReference barycentric_reference(const WindowVertex (&v)[3], int x, int y) {
  const TriangleReference exact(v);
  const auto [low_x, high_x] = std::minmax({v[0].x, v[1].x, v[2].x});
  const auto [low_y, high_y] = std::minmax({v[0].y, v[1].y, v[2].y});
  const bool wide = std::max(high_x - low_x, high_y - low_y) > kMaxEdges32Extent * kSubpixelScale;
  const float largest = std::max({v[0].rw, v[1].rw, v[2].rw});
  const bool all_equal = v[0].rw == v[1].rw && v[1].rw == v[2].rw;
  const bool in_range = largest > 0x1p-120f && largest < 0x1p120f;
  const bool affine = all_equal || !in_range;
  const auto inverse_area = static_cast<float>(1.0 / static_cast<double>(exact.area));

  float weight[3];
  for (int k = 0; k < 3; ++k) {
    const Exact edge = exact.edge[k].at(x, y);
    const float unit = inverse_area * (affine ? 1.0f : std::max(v[k].rw / largest, kMinWeight));
    if (wide) {
      weight[k] = static_cast<float>(static_cast<double>(edge)) * unit;
    } else {
      // Narrow edges are stored in units of 256, rounded down; the remainder is the same at every pixel.
      const auto whole =
          static_cast<std::int64_t>((edge - (exact.edge[k].is_top_left ? 0 : 1)) >> kSubpixelBits);
      const auto rest = static_cast<std::int64_t>(edge - (static_cast<Exact>(whole) << kSubpixelBits));
      weight[k] = std::fma(static_cast<float>(whole), 256.0f * unit, static_cast<float>(rest) * unit);
    }
  }
  if (affine) return {weight[1], weight[2]};
  const float inverse = 1.0f / (weight[0] + weight[1] + weight[2]);
  return {weight[1] * inverse, weight[2] * inverse};
}

}  // namespace tessera::detail
