#include "raster/window_polygon.h"

#include <algorithm>
#include <tuple>

namespace tessera::detail {

WindowPolygon::WindowPolygon(const VertexTransform& transform, const ClippedPolygon& polygon)
    : clipped(polygon) {
  for (int i = 0; i < clipped.count; ++i) window[i] = project(transform, clipped.vertices[i].position);
  for (int i = 2; i < clipped.count; ++i) area += doubled_area(window[0], window[i - 1], window[i]);
  if (!add_fan()) add_ears();
}

WindowPolygon::WindowPolygon(const WindowVertex& a, const WindowVertex& b, const WindowVertex& c)
    : window{a, b, c}, area(doubled_area(a, b, c)) {
  clipped.count = 3;
  add({0, 1, 2});
}

// Doubled area; positive if the triangle winds like the whole polygon.
double WindowPolygon::oriented_area(const Corners& c) const {
  const double turn = doubled_area(window[c[0]], window[c[1]], window[c[2]]);
  return area < 0 ? -turn : turn;
}

// Orders corners by position, so that the result does not depend on the order of the triangle's vertices.
bool WindowPolygon::is_before(int a, int b) const {
  return std::tie(window[a].y, window[a].x, window[a].z) < std::tie(window[b].y, window[b].x, window[b].z);
}

void WindowPolygon::add(const Corners& corners) {
  if (oriented_area(corners) != 0) triangles_[static_cast<std::size_t>(count_++)] = corners;
}

// Splits the polygon into a fan around its topmost corner. Returns false, with no triangles, if one of them
// winds the other way: snapping has made the polygon concave, and the fan would cover pixels of a neighbour.
bool WindowPolygon::add_fan() {
  int first = 0;
  for (int i = 1; i < clipped.count; ++i)
    if (is_before(i, first)) first = i;
  bool is_concave = false;
  for (int i = 2; i < clipped.count; ++i) {
    const Corners corners{first, (first + i - 1) % clipped.count, (first + i) % clipped.count};
    is_concave |= oriented_area(corners) < 0;
    add(corners);
  }
  if (is_concave) count_ = 0;
  return !is_concave;
}

// True if a vertex lies in a triangle or on its edges, and at none of its corners.
bool WindowPolygon::contains(const Corners& c, int vertex) const {
  const bool is_corner = std::any_of(c.begin(), c.end(), [&](int corner) {
    return window[corner].x == window[vertex].x && window[corner].y == window[vertex].y;
  });
  const bool is_inside = oriented_area({c[0], c[1], vertex}) >= 0 &&
                         oriented_area({c[1], c[2], vertex}) >= 0 && oriented_area({c[2], c[0], vertex}) >= 0;
  return !is_corner && is_inside;
}

// True if the triangle can be cut off a polygon with the `remaining` vertices.
bool WindowPolygon::is_ear(const Corners& corners, std::span<const int> remaining) const {
  const double turn = oriented_area(corners);
  if (turn <= 0) return turn == 0;
  return std::none_of(remaining.begin(), remaining.end(), [&](int i) { return contains(corners, i); });
}

// Ear clipping. There is always an ear unless edges cross; then the first corner by position is cut off.
void WindowPolygon::add_ears() {
  std::array<int, kMaxClippedVertices> remaining{};
  for (int i = 0; i < clipped.count; ++i) remaining[static_cast<std::size_t>(i)] = i;
  for (int count = clipped.count; count > 2; --count) {
    const auto corners_at = [&](int i) {
      return Corners{remaining[static_cast<std::size_t>((i + count - 1) % count)],
                     remaining[static_cast<std::size_t>(i)],
                     remaining[static_cast<std::size_t>((i + 1) % count)]};
    };
    // The first ear by position; without ears, the first corner.
    int best = 0;
    bool best_is_ear = false;
    for (int i = 0; i < count; ++i) {
      const bool ear = is_ear(corners_at(i), std::span(remaining).first(static_cast<std::size_t>(count)));
      const bool is_better = ear == best_is_ear ? is_before(corners_at(i)[1], corners_at(best)[1]) : ear;
      if (!is_better) continue;
      best = i;
      best_is_ear = ear;
    }
    add(corners_at(best));
    std::copy(remaining.begin() + best + 1, remaining.begin() + count, remaining.begin() + best);
  }
}

}  // namespace tessera::detail
