// Martin Newell's teapot, evaluated from its bicubic Bezier patches in double. Sums are symmetric in the
// direction of a parameter, so that patches have identical vertices along a shared edge.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include "engine/program/scene/builtin_mesh.h"
#include "engine/program/scene/embedded.h"
#include "engine/program/scene/surface_patch.h"

namespace tessera::program {
namespace {

using Curve = std::array<Vec3, 4>;   // control points of a cubic
using Patch = std::array<Curve, 4>;  // rows; s runs along each, t from row to row

Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Vec3 operator*(double k, Vec3 a) { return {k * a.x, k * a.y, k * a.z}; }
Vec3 cross(Vec3 a, Vec3 b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
double length(Vec3 a) { return std::hypot(a.x, a.y, a.z); }

/// A parameter t and its complement 1 - t, both rounded from fractions. Computing 1 - t would round
/// differently for a curve that runs in the other direction.
struct Parameter {
  double t;
  double complement;
};
Parameter parameter(int i, int n) { return {static_cast<double>(i) / n, static_cast<double>(n - i) / n}; }

bool collapsed(const Curve& c) {
  const auto same = [&](Vec3 p) { return p.x == c[0].x && p.y == c[0].y && p.z == c[0].z; };
  return same(c[1]) && same(c[2]) && same(c[3]);
}

Vec3 point(const Curve& c, Parameter p) {
  if (collapsed(c)) return c[0];  // the sum below could vary with t in the last bit
  const double r = p.complement;
  const double t = p.t;
  return (r * r * r * c[0] + t * t * t * c[3]) + (3 * r * r * t * c[1] + 3 * t * t * r * c[2]);
}

Vec3 derivative(const Curve& c, Parameter p) {
  const double r = p.complement;
  const double t = p.t;
  return 3 * r * r * (c[1] - c[0]) + 6 * r * t * (c[2] - c[1]) + 3 * t * t * (c[3] - c[2]);
}

/// Reduces each row to its point, or derivative, at s: the control points of a curve along t.
template <class Reduce>
Curve across(const Patch& patch, Parameter s, const Reduce& reduce) {
  return {reduce(patch[0], s), reduce(patch[1], s), reduce(patch[2], s), reduce(patch[3], s)};
}

// dP/ds x dP/dt points outwards. dP/ds vanishes in a row that collapses to a point. At a small distance into
// the patch it is that distance times d2P/dsdt, so the normal's limit is the direction of d2P/dsdt x dP/dt,
// negated at the far end of the patch.
Vec3 normal(const Patch& patch, Parameter s, Parameter t) {
  const Curve points = across(patch, s, point);
  const Curve slopes = across(patch, s, derivative);
  const Vec3 along_t = derivative(points, t);
  Vec3 along_s = point(slopes, t);
  if (t.t == 0 && collapsed(patch[0])) along_s = derivative(slopes, t);
  if (t.complement == 0 && collapsed(patch[3])) along_s = -1 * derivative(slopes, t);
  const Vec3 n = cross(along_s, along_t);
  return (1 / length(n)) * n;
}

std::vector<Patch> read_patches() {
  std::istringstream file{std::string(kTeapotPatches)};
  for (std::string comment; file.peek() == '#';) std::getline(file, comment);
  std::size_t patch_count = 0;
  file >> patch_count;
  std::vector<std::array<std::size_t, 16>> corners(patch_count);
  for (auto& patch : corners)
    for (std::size_t& corner : patch) file >> corner;
  std::size_t point_count = 0;
  file >> point_count;
  std::vector<Vec3> points(point_count);
  for (Vec3& p : points) file >> p.x >> p.y >> p.z;

  std::vector<Patch> patches(patch_count);
  for (std::size_t k = 0; k < patch_count; ++k)
    for (std::size_t i = 0; i < 16; ++i) {
      const Vec3 p = points.at(corners[k][i]);
      patches[k][i / 4][i % 4] = {p.x, p.z, -p.y};  // the data has z up
    }
  return patches;
}

// Centres the teapot and scales its longest side to -1..1.
struct Placement {
  Vec3 center;
  double scale = 1;
};

Placement placement(const std::vector<Patch>& patches, int detail) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Vec3 low{kInfinity, kInfinity, kInfinity};
  Vec3 high{-kInfinity, -kInfinity, -kInfinity};
  for (const Patch& patch : patches)
    for (int i = 0; i <= detail; ++i) {
      const Curve curve = across(patch, parameter(i, detail), point);
      for (int j = 0; j <= detail; ++j) {
        const Vec3 p = point(curve, parameter(j, detail));
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
      }
    }
  const Vec3 size = high - low;
  return {0.5 * (low + high), 2 / std::max({size.x, size.y, size.z})};
}

}  // namespace

MeshData teapot_mesh(int detail) {
  const std::vector<Patch> patches = read_patches();
  const auto [center, scale] = placement(patches, detail);
  MeshData mesh;
  for (const Patch& patch : patches)
    append_patch(mesh, detail, detail, [&](int i, int j) {
      const Parameter s = parameter(i, detail);
      const Parameter t = parameter(j, detail);
      return SurfacePoint{scale * (point(across(patch, s, point), t) - center), normal(patch, s, t)};
    });
  return mesh;
}

}  // namespace tessera::program
