// Martin Newell's teapot from its 32 bicubic Bezier patches: analytic positions and normals at each
// parameter.
#include <algorithm>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "builtin_meshes.h"

namespace tessera::reference {
namespace {

#ifdef TESSERA_TEAPOT_PATCHES
std::string teapot_patches_path = TESSERA_TEAPOT_PATCHES;
#else
std::string teapot_patches_path;
#endif

std::string teapot_patches_text;  // empty: read the file

using Weights = std::array<double, 4>;
using Patch = std::array<std::array<Vec3, 4>, 4>;  // [row][column], z up

// File format: comment lines (#), the number of patches, 16 indices per patch, the number of points, three
// coordinates per point.
std::vector<Patch> read_patches() {
  std::ifstream file;
  std::istringstream text(teapot_patches_text);
  if (teapot_patches_text.empty()) file.open(teapot_patches_path);
  if (teapot_patches_text.empty() && !file)
    throw std::runtime_error("cannot read the teapot's patches: '" + teapot_patches_path + "'");
  std::istream& lines = teapot_patches_text.empty() ? static_cast<std::istream&>(file) : text;
  std::stringstream numbers;
  for (std::string line; std::getline(lines, line);)
    if (!line.empty() && line[0] != '#') numbers << line << '\n';

  std::size_t patch_count = 0;
  std::size_t point_count = 0;
  numbers >> patch_count;
  std::vector<std::array<std::size_t, 16>> indices(patch_count);
  for (auto& patch : indices)
    for (auto& index : patch) numbers >> index;
  numbers >> point_count;
  std::vector<Vec3> points(point_count);
  for (auto& p : points) numbers >> p.x >> p.y >> p.z;
  if (!numbers) throw std::runtime_error("the teapot's patches end early: " + teapot_patches_path);

  std::vector<Patch> patches(patch_count);
  for (std::size_t k = 0; k < patch_count; ++k)
    for (std::size_t i = 0; i < 16; ++i) patches[k][i / 4][i % 4] = points.at(indices[k][i]);
  return patches;
}

Weights bernstein(double t) {
  const double r = 1 - t;
  return {r * r * r, 3 * t * r * r, 3 * t * t * r, t * t * t};
}

Weights bernstein_derivative(double t) {
  const double r = 1 - t;
  return {-3 * r * r, 3 * r * r - 6 * t * r, 6 * t * r - 3 * t * t, 3 * t * t};
}

Vec3 combine(const Patch& patch, const Weights& row, const Weights& column) {
  Vec3 sum;
  for (std::size_t r = 0; r < 4; ++r)
    for (std::size_t c = 0; c < 4; ++c) sum = sum + row[r] * column[c] * patch[r][c];
  return sum;
}

// u runs down the rows, v along the columns; dP/dv x dP/du points out of the teapot. Where a row collapses
// into a point (u fixed), dP/dv vanishes. Next to it dP/dv = du d2P/dudv with du pointing into the patch, so
// dP/dv has the direction of d2P/dudv at u = 0 and the opposite one at u = 1. The same holds for a collapsed
// column.
Vec3 unit_normal(const Patch& patch, double u, double v) {
  const Weights bu = bernstein(u);
  const Weights bv = bernstein(v);
  const Weights du = bernstein_derivative(u);
  const Weights dv = bernstein_derivative(v);
  const Vec3 pu = combine(patch, du, bv);
  const Vec3 pv = combine(patch, bu, dv);
  const Vec3 puv = combine(patch, du, dv);
  constexpr double kNull = 1e-9;
  if (const Vec3 n = cross(pv, pu); length(n) > kNull) return normalize(n);
  const double into_u = u < 0.5 ? 1 : -1;
  const double into_v = v < 0.5 ? 1 : -1;
  if (length(pv) <= kNull) {
    if (const Vec3 n = into_u * cross(puv, pu); length(n) > kNull) return normalize(n);
  }
  if (length(pu) <= kNull) {
    if (const Vec3 n = into_v * cross(pv, puv); length(n) > kNull) return normalize(n);
  }
  throw std::runtime_error("a teapot patch has no normal at one of its points");
}

Vec3 z_up_to_y_up(Vec3 p) { return {p.x, p.z, -p.y}; }

}  // namespace

void set_teapot_patches(const std::string& path) { teapot_patches_path = path; }
void set_teapot_patches_text(const std::string& text) { teapot_patches_text = text; }

Mesh teapot_mesh(int detail) {
  Mesh mesh;
  // Parameter s runs along the columns, t down the rows: counter-clockwise.
  for (const Patch& patch : read_patches())
    append_quads(mesh, detail, detail, [&](double s, double t) {
      return SurfacePoint{z_up_to_y_up(combine(patch, bernstein(t), bernstein(s))),
                          z_up_to_y_up(unit_normal(patch, t, s))};
    });

  Vec3 low = xyz(mesh.positions[0]), high = low;
  for (const Vec4 p : mesh.positions) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  const Vec3 center = 0.5 * (low + high);
  const Vec3 size = high - low;
  const double scale = 2 / std::max({size.x, size.y, size.z});
  for (Vec4& p : mesh.positions)
    p = {scale * (p.x - center.x), scale * (p.y - center.y), scale * (p.z - center.z), 1};
  return mesh;
}

}  // namespace tessera::reference
