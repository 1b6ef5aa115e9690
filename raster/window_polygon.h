// What clipping leaves of a triangle, snapped to the window's grid and cut into triangles again.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "raster/clip.h"

namespace tessera::detail {

constexpr double doubled_area(const WindowVertex& a, const WindowVertex& b, const WindowVertex& c) {
  return static_cast<double>(b.x - a.x) * (c.y - a.y) - static_cast<double>(c.x - a.x) * (b.y - a.y);
}

struct WindowPolygon {
  using Corners = std::array<int, 3>;

  ClippedPolygon clipped;
  WindowVertex window[kMaxClippedVertices];
  double area = 0;  ///< doubled; of what snapping left of it

  WindowPolygon(const VertexTransform& transform, const ClippedPolygon& polygon);
  /// A triangle that is not clipped.
  WindowPolygon(const WindowVertex& a, const WindowVertex& b, const WindowVertex& c);

  /// Triangles that cover it exactly, the same ones wherever its corners begin and whichever way round; none
  /// without an area. They turn as it does, unless snapping made its edges cross: that happens to polygons
  /// thinner than a step of the grid, which then overlap their neighbours, and all of it is drawn rather than
  /// holes left.
  std::span<const Corners> triangles() const { return {triangles_.data(), static_cast<std::size_t>(count_)}; }

 private:
  double oriented_area(const Corners& corners) const;
  bool is_before(int a, int b) const;
  void add(const Corners& corners);
  bool add_fan();
  void add_ears();

  std::array<Corners, kMaxClippedVertices - 2> triangles_{};
  int count_ = 0;
};

}  // namespace tessera::detail
