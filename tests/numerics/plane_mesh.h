// A plane in clip space, cut into triangles that are clipped in different ways, and its visible part.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "tests/numerics/counted_mesh.h"
#include "tests/numerics/exact_region.h"

namespace tessera::test {

/// The points origin + u to_u + v to_v, as vectors x y z w. All coordinates are integers that floats hold.
struct ClipPlane {
  ClipPoint origin;
  ClipPoint to_u;
  ClipPoint to_v;

  ClipPoint at(std::int64_t u, std::int64_t v) const {
    const auto on = [&](std::int64_t ClipPoint::*c) { return origin.*c + u * to_u.*c + v * to_v.*c; };
    return {on(&ClipPoint::x), on(&ClipPoint::y), on(&ClipPoint::z), on(&ClipPoint::w)};
  }
  std::optional<VisiblePlane> visible(const SquareViewport& view) const {
    return visible_plane({origin, to_u, to_v}, view);
  }
  /// Mesh with vertices at points (u, v) of the plane, times a power of two.
  CountedMesh mesh_at(const std::vector<WindowPoint>& points, double scale = 1) const {
    CountedMesh mesh;
    for (const WindowPoint& p : points) {
      const ClipPoint c = at(p.x, p.y);
      mesh.add_vertex(scale * static_cast<double>(c.x), scale * static_cast<double>(c.y),
                      scale * static_cast<double>(c.z), scale * static_cast<double>(c.w));
    }
    return mesh;
  }
  /// The part with z and w between near and far, and u and v within `size`.
  ExactRegion region(const VisiblePlane& visible, std::int64_t size, bool reversed = false) const {
    const auto mix = [&](const auto& value) { return visible.mix(value(origin), value(to_u), value(to_v)); };
    ExactRegion region;
    region.inside.push_back(mix([&](const ClipPoint& p) { return reversed ? p.w - p.z : p.w + p.z; }));
    region.inside.push_back(mix([&](const ClipPoint& p) { return reversed ? p.z : p.w - p.z; }));
    region.inside.push_back(visible.coordinates[0]);
    region.outside = region.inside;
    for (const std::int64_t side : {-1, 1}) {
      region.inside.push_back(visible.mix(size, side, 0));
      region.inside.push_back(visible.mix(size, 0, side));
    }
    return region;
  }
};

/// Coordinates of one digit: mostly steep to the window, and crossing all clip planes.
inline ClipPlane random_plane(MeshRandom& random) {
  const auto point = [&] {
    return ClipPoint{random.between(-7, 7), random.between(-7, 7), random.between(-7, 7),
                     random.between(-7, 7)};
  };
  return {point(), point(), point()};
}

/// u and v from -size to size; inner vertices are random whole numbers.
inline Grid random_plane_grid(MeshRandom& random, std::int64_t size, int max_cells) {
  Grid grid;
  do {
    grid = {random.between(1, max_cells), random.between(1, max_cells), {}};
    const double jitter = random.unit();
    const auto place = [&](int n, int last) {
      return std::llround(static_cast<double>(size) *
                          (2 * (n + (n > 0 && n < last ? jitter * (random.unit() - 0.5) : 0)) / last - 1));
    };
    for (int j = 0; j <= grid.rows; ++j)
      for (int i = 0; i <= grid.columns; ++i) {
        const std::int64_t u = place(i, grid.columns);
        grid.points.push_back({u, place(j, grid.rows)});
      }
  } while (grid.folds());
  return grid;
}

}  // namespace tessera::test
