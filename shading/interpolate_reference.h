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

/// Weights of a triangle's vertices.
struct WeightsReference {
  TriangleReference exact;
  bool wide = false;    ///< edges need 64 bits
  bool affine = false;  ///< weights are barycentric coordinates
  float unit[3];        ///< weight per unit of the exact edge

  explicit WeightsReference(const WindowVertex (&v)[3]) : exact(v) {
    const auto [low_x, high_x] = std::minmax({v[0].x, v[1].x, v[2].x});
    const auto [low_y, high_y] = std::minmax({v[0].y, v[1].y, v[2].y});
    wide = std::max(high_x - low_x, high_y - low_y) > kMaxEdges32Extent * kSubpixelScale;
    const float largest = std::max({v[0].rw, v[1].rw, v[2].rw});
    const bool all_equal = v[0].rw == v[1].rw && v[1].rw == v[2].rw;
    const bool in_range = largest > 0x1p-120f && largest < 0x1p120f;
    affine = all_equal || !in_range;
    const auto inverse_area = static_cast<float>(1.0 / static_cast<double>(exact.area));
    for (int k = 0; k < 3; ++k)
      unit[k] = inverse_area * (affine ? 1.0f : std::max(v[k].rw / largest, kMinWeight));
  }

  /// Weight of vertex k at `steps` pixels to the right of and below the centre of a pixel: 0, or 0.5 or 1.5
  /// for the centre of a cell.
  float at(int k, int x, int y, float steps = 0) const {
    const EdgeReference& edge = exact.edge[k];
    const Exact value = edge.at(x, y), step = edge.dx + edge.dy;
    if (wide)
      return static_cast<float>(static_cast<double>(value) + double{steps} * static_cast<double>(step)) *
             unit[k];
    // Narrow edges are stored in units of 256, rounded down; the remainder is the same at every pixel.
    const auto whole = static_cast<std::int64_t>((value - (edge.is_top_left ? 0 : 1)) >> kSubpixelBits);
    const auto rest = static_cast<std::int64_t>(value - (static_cast<Exact>(whole) << kSubpixelBits));
    const float scale = 256.0f * unit[k], shift = static_cast<float>(rest) * unit[k];
    const float whole_step = static_cast<float>(static_cast<std::int64_t>(step >> kSubpixelBits));
    return std::fma(static_cast<float>(whole), scale,
                    steps == 0 ? shift : std::fma(steps * whole_step, scale, shift));
  }
};

inline BarycentricReference barycentric_reference(const WindowVertex (&v)[3], int x, int y) {
  const WeightsReference weights(v);
  float w[3];
  for (int k = 0; k < 3; ++k) w[k] = weights.at(k, x, y);
  if (weights.affine) return {w[1], w[2]};
  const float inverse = 1.0f / (w[0] + w[1] + w[2]);
  return {w[1] * inverse, w[2] * inverse};
}

}  // namespace tessera::detail
