// Clipping of polygons and lines in homogeneous clip space, in double precision.
#pragma once

#include <vector>

#include "scene.h"

namespace tessera::reference {

/// Weights of a point with respect to the corners of its primitive; they sum to 1. Every quantity that is
/// linear in object space is interpolated with these weights.
using CornerWeights = std::vector<double>;

/// A corner before or after clipping.
struct ClipVertex {
  Vec4 position;
  CornerWeights weights;
};

/// Corner `index` of a primitive of `count` corners, at `position`.
ClipVertex corner_vertex(Vec4 position, std::size_t index, std::size_t count);

/// Clip volume: w > 0, the camera's near and far plane, |x| <= guard_x w and |y| <= guard_y w. The guard band
/// lies far outside the picture and keeps window coordinates within the bounds of exact arithmetic.
struct ClipVolume {
  bool reversed = false;
  bool infinite_far = false;
  double guard_x = 0;
  double guard_y = 0;
};

/// Returns the clipped convex polygon in its winding order; empty if nothing remains.
std::vector<ClipVertex> clip_polygon(std::vector<ClipVertex> polygon, const ClipVolume& volume);

/// Returns the clipped segment in its direction; empty if nothing remains.
std::vector<ClipVertex> clip_line(ClipVertex from, ClipVertex to, const ClipVolume& volume);

/// Whether a point is drawn. Its centre must be inside the near and far plane and inside the sides of the
/// view volume, whatever its size [GL 2.1, 2.12].
bool is_in_view(Vec4 position, const ClipVolume& volume);

/// Whether the corner of a clipped polygon is drawn as a point; it lies inside the near and far plane
/// already.
bool is_between_sides(Vec4 position);

}  // namespace tessera::reference
