// Triangle coverage, and barycentric weights of each pixel: snapped vertices, exact edge functions, the
// top-left rule, at each sample's position. Independent of colours.
#pragma once

#include <vector>

#include "window.h"

namespace tessera::reference {

/// A polygon in the window: a clipped triangle, snapped.
class WindowPolygon {
 public:
  WindowPolygon(const std::vector<ClipVertex>& polygon, const Window& window);

  /// Twice the area of the snapped polygon in (1/256 pixel)^2, positive if counter-clockwise with y up.
  std::int64_t signed_area() const { return signed_area_; }

  /// max(|dz/dx|, |dz/dy|) of window depth, per pixel.
  double depth_slope() const;

  /// Largest |z| of the vertices in the window.
  double largest_depth() const;

  /// Calls `take` for each covered pixel.
  /// @param depth_offset  added to every depth before it is clamped to 0..1.
  void for_each_fragment(double depth_offset, const FragmentCallback& take) const;

 private:
  /// Counter-clockwise, of positive area.
  struct Part {
    WindowVertex a;
    WindowVertex b;
    WindowVertex c;
    std::int64_t area;
  };

  const Part& largest_part() const;

  std::vector<WindowVertex> vertices_;
  std::vector<Part> parts_;  // triangle fan of the polygon
  std::int64_t signed_area_ = 0;
  Window window_;
};

}  // namespace tessera::reference
