// Clipping of triangles in homogeneous clip space, in double precision.
#pragma once

#include <vector>

#include "scene.h"

namespace tessera::reference {

/// A corner of a clipped polygon: where it is, and its share of each of the triangle's three corners (they sum to 1).
/// Every quantity that is linear in object space is the same mixture of its values at the three corners.
struct ClipVertex {
  Vec4 position;
  Vec3 share;
};

/// What to clip against besides w > 0 and the near and far plane of the camera: |x| <= guard_x w and |y| <= guard_y w,
/// far outside the picture, so that window coordinates stay within the bounds of exact arithmetic.
struct ClipVolume {
  bool reversed = false;
  bool infinite_far = false;
  double guard_x = 0;
  double guard_y = 0;
};

/// The convex polygon that is left, in the triangle's winding order; empty if nothing is.
std::vector<ClipVertex> clip_triangle(const std::array<Vec4, 3>& positions, const ClipVolume& volume);

}  // namespace tessera::reference
