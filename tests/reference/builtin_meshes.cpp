#include "builtin_meshes.h"

#include <numbers>
#include <stdexcept>

namespace tessera::reference {
namespace {

// Cosine and sine of the fraction `turn` of a full turn, exact at the four quarters so that seams and poles
// close.
struct Circle {
  double cosine, sine;
};

Circle circle(double turn) {
  if (turn == 0 || turn == 1) return {1, 0};
  if (turn == 0.25) return {0, 1};
  if (turn == 0.5) return {-1, 0};
  if (turn == 0.75) return {0, -1};
  return {std::cos(2 * std::numbers::pi * turn), std::sin(2 * std::numbers::pi * turn)};
}

// Around the y axis, counter-clockwise as viewed from above: from +x through -z.
Vec3 around_y(double turn, double radius, double y) {
  const auto [c, s] = circle(turn);
  return {radius * c, y, -radius * s};
}

Mesh sphere(int n) {
  Mesh mesh;
  append_quads(mesh, 2 * n, n, [](double s, double t) {
    const auto [minus_y, radius] = circle(t / 2);
    const Vec3 p = around_y(s, radius, -minus_y);
    return SurfacePoint{p, p};
  });
  return mesh;
}

Mesh torus(int n) {
  constexpr double kRing = 0.7;
  constexpr double kTube = 0.3;
  Mesh mesh;
  append_quads(mesh, 2 * n, n, [](double s, double t) {
    const auto [cs, ss] = circle(s);
    const auto [ct, st] = circle(t);
    const Vec3 normal{ct * cs, ct * ss, st};
    return SurfacePoint{Vec3{kRing * cs, kRing * ss, 0} + kTube * normal, normal};
  });
  return mesh;
}

// A square of n x n quads at `normal`, s along `right`, t along `up`.
void append_square(Mesh& mesh, int n, Vec3 right, Vec3 up, Vec3 offset) {
  const Vec3 normal = cross(right, up);
  append_quads(mesh, n, n, [&](double s, double t) {
    return SurfacePoint{offset + (2 * s - 1) * right + (2 * t - 1) * up, normal};
  });
}

Mesh cube(int n) {
  const Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  Mesh mesh;
  append_square(mesh, n, x, y, z);
  append_square(mesh, n, -x, y, -z);
  append_square(mesh, n, -z, y, x);
  append_square(mesh, n, z, y, -x);
  append_square(mesh, n, x, -z, y);
  append_square(mesh, n, x, z, -y);
  return mesh;
}

Mesh grid(int n) {
  Mesh mesh;
  append_square(mesh, n, {1, 0, 0}, {0, 1, 0}, {});
  return mesh;
}

// A disc of 2n triangles around its centre at height y, facing `up` (+1 or -1).
void append_cap(Mesh& mesh, int n, double y, double up) {
  append_quads(mesh, 2 * n, 1, [&](double s, double t) {
    return SurfacePoint{around_y(up * s, 1 - t, y), {0, up, 0}};
  });
}

Mesh cylinder(int n) {
  Mesh mesh;
  append_quads(mesh, 2 * n, 1, [](double s, double t) {
    return SurfacePoint{around_y(s, 1, 2 * t - 1), around_y(s, 1, 0)};
  });
  append_cap(mesh, n, 1, 1);
  append_cap(mesh, n, -1, -1);
  return mesh;
}

// A cone of height 2 and radius 1. Normals of its side are (2 cos, 1, 2 sin) / sqrt(5); each wedge has a
// separate normal at the apex.
Mesh cone(int n) {
  Mesh mesh;
  append_quads(mesh, 2 * n, 1, [](double s, double t) {
    return SurfacePoint{around_y(s, 1 - t, 2 * t - 1), normalize(around_y(s, 2, 1))};
  });
  append_cap(mesh, n, -1, -1);
  return mesh;
}

}  // namespace

Mesh builtin_mesh(const std::string& name, int detail) {
  if (detail < 1) throw std::runtime_error("builtin mesh " + name + ": detail must be at least 1");
  if (name == "teapot") return teapot_mesh(detail);
  if (name == "sphere") return sphere(detail);
  if (name == "torus") return torus(detail);
  if (name == "cube") return cube(detail);
  if (name == "cylinder") return cylinder(detail);
  if (name == "cone") return cone(detail);
  if (name == "quad") return grid(1);
  if (name == "grid") return grid(detail);
  throw std::runtime_error("unknown builtin mesh: " + name);
}

}  // namespace tessera::reference
