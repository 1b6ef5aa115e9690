// Exact visible regions of a plane in clip space: window regions bounded by straight lines with whole-number
// coefficients.
//
// A point p0 a + p1 b + p2 c of the plane through three points (x y z w vectors) is visible at the window
// point q = (X, Y, 1) if its x, y and w are a positive multiple of q. By Cramer's rule a, b and c are linear
// functions of q; so are z, all clip plane distances, and attributes.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "tests/numerics/counted_mesh.h"

namespace tessera::test {

__extension__ using Wide = __int128;

/// A point in clip space with integer coordinates.
struct ClipPoint {
  std::int64_t x = 0, y = 0, z = 0, w = 1;
};

/// A square viewport; x, y is its lower left corner in pixels, relative to the buffer's.
struct SquareViewport {
  int x = 0;
  int y = 0;
  int side = 64;
};

/// x dx + y dy + one, for a window point in half pixels from the viewport's centre.
struct Linear {
  Wide dx = 0;
  Wide dy = 0;
  Wide one = 0;
  Wide at(Wide x, Wide y) const { return dx * x + dy * y + one; }
  long double at(long double x, long double y) const {
    return static_cast<long double>(dx) * x + static_cast<long double>(dy) * y +
           static_cast<long double>(one);
  }
  friend Linear operator+(const Linear& a, const Linear& b) {
    return {a.dx + b.dx, a.dy + b.dy, a.one + b.one};
  }
  friend Linear operator*(std::int64_t f, const Linear& a) { return {f * a.dx, f * a.dy, f * a.one}; }
};

/// Largest distance in x and in y between a vertex as drawn and its exact position: half of the 1/256 pixel
/// snapping step plus 2^-12 pixel. The latter covers the double roundings of clipping, each about 2^-52 of
/// 16,383 pixels. The distance is kReach / kReachScale half pixels.
inline constexpr int kReach = 9;
inline constexpr int kReachScale = 2048;
static_assert(kReach == kReachScale / 256 + kReachScale / 2048);

/// Coordinates of the plane's point visible at a window point: positive multiples of a, b and c above.
struct VisiblePlane {
  std::array<Linear, 3> coordinates;

  Linear mix(std::int64_t a, std::int64_t b, std::int64_t c) const {
    return a * coordinates[0] + b * coordinates[1] + c * coordinates[2];
  }
};

/// Empty for a plane through the eye.
inline std::optional<VisiblePlane> visible_plane(const std::array<ClipPoint, 3>& p,
                                                 const SquareViewport& view) {
  VisiblePlane plane;
  Wide determinant = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    // The determinant with q in place of p[k].
    const ClipPoint& a = p[(k + 1) % 3];
    const ClipPoint& b = p[(k + 2) % 3];
    const Linear cofactors{Wide{a.y} * b.w - Wide{a.w} * b.y, Wide{a.w} * b.x - Wide{a.x} * b.w,
                           Wide{a.x} * b.y - Wide{a.y} * b.x};
    determinant = cofactors.dx * p[k].x + cofactors.dy * p[k].y + cofactors.one * p[k].w;
    plane.coordinates[k] = {cofactors.dx, cofactors.dy, cofactors.one * view.side};
  }
  if (determinant == 0) return std::nullopt;
  if (determinant < 0)
    for (Linear& c : plane.coordinates) c = -1 * c;
  return plane;
}

/// The region where all of several functions are positive.
struct ExactRegion {
  std::vector<Linear> inside;   ///< bounds of the region
  std::vector<Linear> outside;  ///< Nothing is drawn where any of these is negative.

  enum class Side { in, out, near_edge };
  /// `near the edge`: the point is inside after some move of up to kReach in x and y, and outside after
  /// another. Vertices are drawn within that distance, so the drawn part of a convex polygon contains every
  /// point farther inside and no point farther outside.
  Side side(Wide x, Wide y) const {
    const auto margin = [](const Linear& l) {
      return kReach * ((l.dx < 0 ? -l.dx : l.dx) + (l.dy < 0 ? -l.dy : l.dy));
    };
    if (std::any_of(outside.begin(), outside.end(),
                    [&](const Linear& l) { return kReachScale * l.at(x, y) < -margin(l); }))
      return Side::out;
    return std::all_of(inside.begin(), inside.end(),
                       [&](const Linear& l) { return kReachScale * l.at(x, y) > margin(l); })
               ? Side::in
               : Side::near_edge;
  }
};

/// Centre of a pixel in half pixels from the viewport's centre; rows from the top of a buffer that is
/// `height` pixels high.
inline std::array<Wide, 2> center_of(int column, int row, int height, const SquareViewport& view) {
  return {2 * (column - view.x) + 1 - view.side, 2 * (height - 1 - row - view.y) + 1 - view.side};
}

/// Expected coverage of a buffer's pixels by a mesh that fills the region without gaps and overlaps.
inline std::vector<Cover> covers_of(const ExactRegion& region, int width, int height,
                                    const SquareViewport& view) {
  std::vector<Cover> covers;
  for (int row = 0; row < height; ++row)
    for (int column = 0; column < width; ++column) {
      const auto [x, y] = center_of(column, row, height, view);
      const ExactRegion::Side side = region.side(x, y);
      if (side == ExactRegion::Side::in) covers.push_back(Cover::once);
      else covers.push_back(side == ExactRegion::Side::out ? Cover::never : Cover::at_most_once);
    }
  return covers;
}

}  // namespace tessera::test
