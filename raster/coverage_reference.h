// Scalar twin and specification of coverage-inl.h: the pixels that a triangle covers, in 128-bit integers
// from its snapped vertices.
#pragma once

#include <cstdint>

#include "raster/fixed_point.h"

namespace tessera::detail {

__extension__ using Exact = __int128;

/// Exact edge function at pixel centres, positive inside.
struct EdgeReference {
  Exact at_origin = 0;       ///< at pixel (0, 0)
  Exact dx = 0, dy = 0;      ///< steps to the next pixel to the right and below
  bool is_top_left = false;  ///< pixel centres on the edge belong to the triangle
  Exact at(int x, int y) const { return at_origin + dx * x + dy * y; }
};

struct TriangleReference {
  EdgeReference edge[3];  ///< edge k lies opposite vertex k
  /// Doubled area in (1/256 pixel)^2, never negative: the sum of the three edges at any point.
  Exact area = 0;

  explicit TriangleReference(const WindowVertex (&v)[3]) {
    const auto cross = [](Exact ax, Exact ay, Exact bx, Exact by) { return ax * by - ay * bx; };
    const Exact signed_area = cross(v[1].x - v[0].x, v[1].y - v[0].y, v[2].x - v[0].x, v[2].y - v[0].y);
    const int sign = signed_area < 0 ? -1 : 1;
    area = signed_area * sign;
    for (int k = 0; k < 3; ++k) {
      const WindowVertex &p = v[(k + 1) % 3], &q = v[(k + 2) % 3];
      const Exact along_x = sign * (Exact{q.x} - p.x), along_y = sign * (Exact{q.y} - p.y);
      edge[k].at_origin = cross(along_x, along_y, Exact{kHalfPixel} - p.x, Exact{kHalfPixel} - p.y);
      edge[k].dx = -along_y * kSubpixelScale;
      edge[k].dy = along_x * kSubpixelScale;
      // Fill rule: a centre on an edge is classified as if moved by (e, e^2) with an infinitesimal e: to the
      // right and, by less, down.
      edge[k].is_top_left = edge[k].dx > 0 || (edge[k].dx == 0 && edge[k].dy > 0);
    }
  }

  bool covers(int x, int y) const {
    if (area == 0) return false;
    for (const EdgeReference& e : edge) {
      const Exact value = e.at(x, y);
      if (value < 0 || (value == 0 && !e.is_top_left)) return false;
    }
    return true;
  }

  /// Calls pixel(x, y) for the covered pixels with x0 <= x < x1, y0 <= y < y1.
  template <class PixelFunction>
  void for_each_covered(int x0, int y0, int x1, int y1, const PixelFunction& pixel) const {
    if (area == 0) return;
    // An edge that does not belong to the triangle is biased by -1, the smallest integer step.
    Exact row[3];
    for (int k = 0; k < 3; ++k) row[k] = edge[k].at(x0, y0) - (edge[k].is_top_left ? 0 : 1);
    for (int y = y0; y < y1; ++y) {
      Exact e[3] = {row[0], row[1], row[2]};
      for (int x = x0; x < x1; ++x) {
        if (e[0] >= 0 && e[1] >= 0 && e[2] >= 0) pixel(x, y);
        for (int k = 0; k < 3; ++k) e[k] += edge[k].dx;
      }
      for (int k = 0; k < 3; ++k) row[k] += edge[k].dy;
    }
  }
};

}  // namespace tessera::detail
