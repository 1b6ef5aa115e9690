// A clipped triangle, snapped to the raster grid and split into triangles.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "raster/clip.h"

namespace tessera::detail {

/// Twice the signed area, exact; positive for clockwise triangles on screen (raster space, y down).
constexpr double doubled_area(const WindowVertex& a, const WindowVertex& b, const WindowVertex& c) {
  return static_cast<double>(b.x - a.x) * (c.y - a.y) - static_cast<double>(c.x - a.x) * (b.y - a.y);
}

struct WindowPolygon {
  using Corners = std::array<int, 3>;

  ClippedPolygon clipped;
  WindowVertex window[kMaxClippedVertices];
  double area = 0;  ///< doubled signed area after snapping

  WindowPolygon(const VertexTransform& transform, const ClippedPolygon& polygon);
  /// An unclipped triangle.
  WindowPolygon(const WindowVertex& a, const WindowVertex& b, const WindowVertex& c);

  /// Triangles with an area that cover the polygon exactly and wind like it. Independent of the polygon's
  /// first corner and direction. Exception: if snapping made edges cross, which happens to polygons thinner
  /// than a grid step, all of the polygon is covered, and it may overlap its neighbours, but leaves no holes.
  std::span<const Corners> triangles() const { return {triangles_.data(), static_cast<std::size_t>(count_)}; }

 private:
  double oriented_area(const Corners& corners) const;
  bool is_before(int a, int b) const;
  void add(const Corners& corners);
  bool contains(const Corners& corners, int vertex) const;
  bool is_ear(const Corners& corners, std::span<const int> remaining) const;
  bool add_fan();
  void add_ears();

  std::array<Corners, kMaxClippedVertices - 2> triangles_{};
  int count_ = 0;
};

}  // namespace tessera::detail
