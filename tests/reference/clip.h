// Clipping of polygons and lines in homogeneous clip space, in double precision.
#pragma once

#include <vector>

#include "scene.h"

namespace tessera::reference {

/// How much of each of a primitive's corners a point of it is made of; the shares sum to 1. Every quantity
/// that is linear in object space is the same mixture of its values at the corners.
using CornerWeights = std::vector<double>;

/// A corner of what is left after clipping, or of what goes in.
struct ClipVertex {
  Vec4 position;
  CornerWeights weights;
};

/// Corner `index` of a primitive of `count` corners, at `position`.
ClipVertex corner_vertex(Vec4 position, std::size_t index, std::size_t count);

/// What to clip against besides w > 0 and the near and far plane of the camera: |x| <= guard_x w and |y| <=
/// guard_y w, far outside the picture, so that window coordinates stay within the bounds of exact arithmetic.
struct ClipVolume {
  bool reversed = false;
  bool infinite_far = false;
  double guard_x = 0;
  double guard_y = 0;
};

/// The convex polygon that is left of one, in its winding order; empty if nothing is.
std::vector<ClipVertex> clip_polygon(std::vector<ClipVertex> polygon, const ClipVolume& volume);

/// The segment that is left of one, in its direction; empty if nothing is.
std::vector<ClipVertex> clip_line(ClipVertex from, ClipVertex to, const ClipVolume& volume);

/// Whether a point is drawn: not only the near and far plane but the sides of the view volume too decide by
/// its centre, whatever its size [GL 2.1, 2.12].
bool is_in_view(Vec4 position, const ClipVolume& volume);

/// The same for the corner of a clipped polygon, for which the near and far plane have been asked.
bool is_between_sides(Vec4 position);

}  // namespace tessera::reference
