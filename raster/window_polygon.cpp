#include "raster/window_polygon.h"

#include <algorithm>

namespace tessera {

WindowPolygon::WindowPolygon(const VertexTransform& transform, const ClippedPolygon& polygon) : clipped(polygon) {
  for (int i = 0; i < clipped.count; ++i) window[i] = project(transform, clipped.vertices[i].position);
  for (int i = 2; i < clipped.count; ++i) area += doubled_area(window[0], window[i - 1], window[i]);
  if (is_star()) {
    for (int i = 2; i < clipped.count; ++i) add({0, i - 1, i});
  } else {
    add_ears();
  }
}

WindowPolygon::WindowPolygon(const WindowVertex& a, const WindowVertex& b, const WindowVertex& c) : window{a, b, c}, area(doubled_area(a, b, c)) {
  clipped.count = 3;
  add({0, 1, 2});
}

// Positive for triangles that turn as the whole does.
double WindowPolygon::turn_of(const Corners& c) const {
  const double turn = doubled_area(window[c[0]], window[c[1]], window[c[2]]);
  return area < 0 ? -turn : turn;
}

// Whether all of it is seen from the first corner. Snapping may dent a polygon: then triangles from there on cover the dent, which is a neighbour's, and
// one is turned over.
bool WindowPolygon::is_star() const {
  for (int i = 2; i < clipped.count; ++i)
    if (turn_of({0, i - 1, i}) < 0) return false;
  return true;
}

void WindowPolygon::add(const Corners& corners) {
  if (turn_of(corners) != 0) triangles_[static_cast<std::size_t>(count_++)] = corners;
}

// Cuts off one corner after the other, none together with which others would go. There is always one, unless edges cross.
void WindowPolygon::add_ears() {
  std::array<int, kMaxClippedVertices> left{};
  for (int i = 0; i < clipped.count; ++i) left[static_cast<std::size_t>(i)] = i;
  for (int count = clipped.count; count > 2; --count) {
    const auto ear_at = [&](int i) { return Corners{left[static_cast<std::size_t>((i + count - 1) % count)], left[static_cast<std::size_t>(i)], left[static_cast<std::size_t>((i + 1) % count)]}; };
    const auto is_ear = [&](const Corners& ear) {
      const auto holds = [&](int other) {
        const bool is_corner = std::any_of(ear.begin(), ear.end(), [&](int c) { return window[c].x == window[other].x && window[c].y == window[other].y; });
        return !is_corner && turn_of({ear[0], ear[1], other}) >= 0 && turn_of({ear[1], ear[2], other}) >= 0 && turn_of({ear[2], ear[0], other}) >= 0;
      };
      return turn_of(ear) == 0 || (turn_of(ear) > 0 && std::none_of(left.begin(), left.begin() + count, holds));
    };
    int at = 0;
    while (at + 1 < count && !is_ear(ear_at(at))) ++at;
    add(ear_at(at));
    std::copy(left.begin() + at + 1, left.begin() + count, left.begin() + at);
  }
}

}  // namespace tessera
