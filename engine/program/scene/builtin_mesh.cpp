// Sphere, torus, cube, cylinder, cone, quad and grid. The points of each circle are computed once, so both
// sides of a seam have identical coordinates.
#include "engine/program/scene/builtin_mesh.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "engine/program/scene/surface_patch.h"

namespace tessera::program {
namespace {

/// `count` points of the unit circle, counter-clockwise from (1, 0).
class Circle {
 public:
  struct Point {
    double cosine, sine;
  };

  explicit Circle(int count) {
    // Exact: cos() and sin() would not return 0 here, and a sphere's pole would not be one point.
    constexpr Point kQuarters[4] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
    for (int i = 0; i < count; ++i) {
      const double angle = 2 * std::numbers::pi * i / count;
      points_.push_back(4 * i % count == 0 ? kQuarters[4 * i / count]
                                           : Point{std::cos(angle), std::sin(angle)});
    }
  }
  /// Wraps around.
  /// @param i  0 or more
  Point at(int i) const { return points_[static_cast<std::size_t>(i) % points_.size()]; }
  /// Point of a circle around the y axis: from +x towards -z, counter-clockwise as viewed from above.
  Vec3 around_y(int i, double radius, double y) const {
    const Point p = at(i);
    return {radius * p.cosine, y, -radius * p.sine};
  }

 private:
  std::vector<Point> points_;
};

MeshData sphere(int n) {
  MeshData mesh;
  const Circle circle(2 * n);
  append_patch(mesh, 2 * n, n, [&](int i, int j) {
    const auto [height, radius] = circle.at(j);  // meridian: half the circle, from pole to pole
    const Vec3 p = circle.around_y(i, radius, -height);
    return SurfacePoint{p, p};
  });
  return mesh;
}

MeshData torus(int n) {
  constexpr double kRingRadius = 0.7;
  constexpr double kTubeRadius = 0.3;
  MeshData mesh;
  const Circle ring(2 * n);
  const Circle tube(n);
  append_patch(mesh, 2 * n, n, [&](int i, int j) {
    const auto on_ring = ring.at(i);
    const auto on_tube = tube.at(j);
    const double radius = kRingRadius + kTubeRadius * on_tube.cosine;
    return SurfacePoint{{radius * on_ring.cosine, radius * on_ring.sine, kTubeRadius * on_tube.sine},
                        {on_tube.cosine * on_ring.cosine, on_tube.cosine * on_ring.sine, on_tube.sine}};
  });
  return mesh;
}

/// Appends a square of side 2 around `center`, as n x n quads.
/// @param right, up  unit vectors along which s and t grow
void append_square(MeshData& mesh, int n, Vec3 center, Vec3 right, Vec3 up) {
  const Vec3 normal{right.y * up.z - right.z * up.y, right.z * up.x - right.x * up.z,
                    right.x * up.y - right.y * up.x};
  append_patch(mesh, n, n, [&](int i, int j) {
    const double x = static_cast<double>(2 * i - n) / n;
    const double y = static_cast<double>(2 * j - n) / n;
    return SurfacePoint{{center.x + x * right.x + y * up.x, center.y + x * right.y + y * up.y,
                         center.z + x * right.z + y * up.z},
                        normal};
  });
}

MeshData cube(int n) {
  MeshData mesh;
  append_square(mesh, n, {0, 0, 1}, {1, 0, 0}, {0, 1, 0});
  append_square(mesh, n, {0, 0, -1}, {-1, 0, 0}, {0, 1, 0});
  append_square(mesh, n, {1, 0, 0}, {0, 0, -1}, {0, 1, 0});
  append_square(mesh, n, {-1, 0, 0}, {0, 0, 1}, {0, 1, 0});
  append_square(mesh, n, {0, 1, 0}, {1, 0, 0}, {0, 0, -1});
  append_square(mesh, n, {0, -1, 0}, {1, 0, 0}, {0, 0, 1});
  return mesh;
}

MeshData grid(int n) {
  MeshData mesh;
  append_square(mesh, n, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  return mesh;
}

/// Appends a disc at height y, as triangles that meet at its centre. s runs counter-clockwise as viewed from
/// outside.
void append_cap(MeshData& mesh, const Circle& circle, int triangles, double y, bool faces_up) {
  append_patch(mesh, triangles, 1, [&](int i, int j) {
    return SurfacePoint{circle.around_y(faces_up ? i : triangles - i, 1.0 - j, y),
                        {0, faces_up ? 1.0 : -1.0, 0}};
  });
}

MeshData cylinder(int n) {
  MeshData mesh;
  const Circle circle(2 * n);
  append_patch(mesh, 2 * n, 1, [&](int i, int j) {
    return SurfacePoint{circle.around_y(i, 1, 2 * j - 1), circle.around_y(i, 1, 0)};
  });
  append_cap(mesh, circle, 2 * n, 1, true);
  append_cap(mesh, circle, 2 * n, -1, false);
  return mesh;
}

/// A cone of height 2 and radius 1. Normals of its side are (2 cos, 1, 2 sin) / sqrt(5). Each triangle has a
/// separate vertex, with its normal, at the apex.
MeshData cone(int n) {
  MeshData mesh;
  const Circle circle(2 * n);
  const double normal_y = 1 / std::sqrt(5.0);
  append_patch(mesh, 2 * n, 1, [&](int i, int j) {
    return SurfacePoint{circle.around_y(i, 1.0 - j, 2 * j - 1), circle.around_y(i, 2 * normal_y, normal_y)};
  });
  append_cap(mesh, circle, 2 * n, -1, false);
  return mesh;
}

MeshData make_mesh(std::string_view name, int detail) {
  if (name == "teapot") return teapot_mesh(detail);
  if (name == "sphere") return sphere(detail);
  if (name == "torus") return torus(detail);
  if (name == "cube") return cube(detail);
  if (name == "cylinder") return cylinder(detail);
  if (name == "cone") return cone(detail);
  return grid(name == "quad" ? 1 : detail);
}

}  // namespace

int min_mesh_detail(std::string_view name) { return name == "sphere" || name == "torus" ? 2 : 1; }

MeshData builtin_mesh(std::string_view name, int detail) {
  const std::string text(name);
  if (std::find(kBuiltinMeshNames.begin(), kBuiltinMeshNames.end(), name) == kBuiltinMeshNames.end())
    throw Error("there is no built-in mesh \"" + text + "\"");
  if (detail < min_mesh_detail(name) || detail > kMaxMeshDetail)
    throw Error("the detail of a built-in " + text + " is " + std::to_string(detail) + ", must be " +
                std::to_string(min_mesh_detail(name)) + " to " + std::to_string(kMaxMeshDetail));

  MeshData mesh = make_mesh(name, detail);
  mesh.name = text;
  return mesh;
}

}  // namespace tessera::program
