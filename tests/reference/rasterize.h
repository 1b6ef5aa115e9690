// Which pixels a triangle covers, and where in the triangle each of them lies: snapped vertices, exact edge functions, the
// top-left rule. Nothing here knows of colours.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "clip.h"
#include "scene.h"

namespace tessera::reference {

/// Where on the screen a draw may leave fragments.
struct Window {
  Rect viewport;  ///< may reach beyond the buffer
  Rect visible;   ///< viewport, scissor and buffer in common
  std::array<double, 2> depth_range{0, 1};
  bool reversed = false;
};

/// The part that two rectangles have in common; width or height 0 if there is none.
Rect intersection(Rect a, Rect b);

/// A guard band that keeps every snapped coordinate exact in the edge functions (see rasterize.cpp).
ClipVolume clip_volume(const Camera& camera, Rect viewport);

struct Fragment {
  int x = 0, y = 0;  ///< window, y up
  double depth = 0;  ///< after the depth range, 0..1, not yet rounded to a level
  Vec3 share;        ///< perspective-correct share of each of the triangle's three corners
};

/// A polygon in the window: the clipped triangle, snapped.
class WindowPolygon {
 public:
  WindowPolygon(const std::vector<ClipVertex>& polygon, const Window& window);

  /// Twice the area of the snapped polygon in (1/256 pixel)^2, above 0 if it is counter-clockwise with y up.
  std::int64_t signed_area() const;

  /// Calls `take` for each pixel covered.
  void for_each_fragment(const std::function<void(const Fragment&)>& take) const;

 private:
  struct Vertex {
    std::int64_t x, y;  // 1/256 pixel from the viewport's lower left corner
    double depth;
    double inverse_w;
    Vec3 share;
  };

  void rasterize(const Vertex& a, const Vertex& b, const Vertex& c, const std::function<void(const Fragment&)>& take) const;

  std::vector<Vertex> vertices_;
  Window window_;
};

}  // namespace tessera::reference
