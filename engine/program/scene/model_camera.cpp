#include "engine/program/scene/model_camera.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "engine/tessera/tessera.hpp"

namespace tessera::program {
namespace {

constexpr double kFovy = 36;  // degrees

double dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

// Ignores vertices that are not finite, which are not drawn.
Vec3 center_of_bounds(const MeshData& mesh) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  std::array<double, 3> low{kInfinity, kInfinity, kInfinity};
  std::array<double, 3> high{-kInfinity, -kInfinity, -kInfinity};
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    if (!std::isfinite(mesh.positions[i])) continue;
    low[i % 3] = std::min<double>(low[i % 3], mesh.positions[i]);
    high[i % 3] = std::max<double>(high[i % 3], mesh.positions[i]);
  }
  return {(low[0] + high[0]) / 2, (low[1] + high[1]) / 2, (low[2] + high[2]) / 2};
}

// Views the model from the front, slightly from above and from the right, as near as the picture's edges
// allow. A vertex at x, y and z (towards the viewer) is visible if |y| <= (distance - z) tan(fovy / 2);
// likewise for x.
SceneCamera framing_camera(const MeshData& mesh, double aspect, bool all_sides, const std::string& name) {
  const SinCos azimuth = sin_cos_degrees(25);
  const SinCos elevation = sin_cos_degrees(17);
  const SinCos half_fovy = sin_cos_degrees(kFovy / 2);
  const Vec3 right{azimuth.cosine, 0, -azimuth.sine};
  // Points towards the viewer.
  const Vec3 back{elevation.cosine * azimuth.sine, elevation.sine, elevation.cosine * azimuth.cosine};
  const Vec3 up{-elevation.sine * azimuth.sine, elevation.cosine, -elevation.sine * azimuth.cosine};
  const Vec3 center = center_of_bounds(mesh);

  constexpr double kMargin = 1.08;
  constexpr int kSides = 24;
  const double tangent_y = half_fovy.sine / half_fovy.cosine / kMargin;
  const double tangent_x = tangent_y * aspect;
  double distance = 0;
  double radius = 0;
  for (std::size_t i = 0; i < mesh.positions.size(); i += 3) {
    const Vec3 p{mesh.positions[i] - center.x, mesh.positions[i + 1] - center.y,
                 mesh.positions[i + 2] - center.z};
    if (!std::isfinite(p.x + p.y + p.z)) continue;
    const auto needed = [&](const Vec3& q) {
      return dot(q, back) + std::max(std::abs(dot(q, right)) / tangent_x, std::abs(dot(q, up)) / tangent_y);
    };
    distance = std::max(distance, needed(p));
    for (int side = 1; all_sides && side < kSides; ++side) {
      const SinCos turn = sin_cos_degrees(360.0 * side / kSides);
      distance = std::max(
          distance, needed({turn.cosine * p.x + turn.sine * p.z, p.y, turn.cosine * p.z - turn.sine * p.x}));
    }
    radius = std::max(radius, std::sqrt(dot(p, p)));
  }
  if (!(radius > 0) || !std::isfinite(radius))
    throw Error(name + ": the model has no extent for a camera to frame");
  // Keeps the eye away from models that are long in the direction of view.
  distance = std::max(distance, 1.5 * radius);
  const Vec3 eye{center.x + distance * back.x, center.y + distance * back.y, center.z + distance * back.z};
  return camera_at({.eye = eye, .target = center, .up = {0, 1, 0}},
                   {.fovy = kFovy, .near = distance - 1.01 * radius, .far = distance + 1.01 * radius});
}

// Returns a camera of the file, unless the whole model lies behind it. For depth precision, near and far are
// moved as close to the model as the file allows.
std::optional<SceneCamera> camera_of_model(const ModelCamera& camera, const MeshData& mesh, double aspect) {
  // Distances along the direction of view.
  double min_distance = std::numeric_limits<double>::infinity();
  double max_distance = 0;
  const double* const row = &camera.view.m[8];
  for (std::size_t i = 0; i < mesh.positions.size(); i += 3) {
    const double distance = -(row[0] * mesh.positions[i] + row[1] * mesh.positions[i + 1] +
                              row[2] * mesh.positions[i + 2] + row[3]);
    if (!std::isfinite(distance)) continue;
    min_distance = std::min(min_distance, distance);
    max_distance = std::max(max_distance, distance);
  }
  constexpr double kMargin = 1.01;
  constexpr double kMaxFarNearRatio = 1e5;
  const double given_far =
      camera.far > std::max(camera.near, 0.0) ? camera.far : std::numeric_limits<double>::infinity();
  const double far = max_distance > 0 ? std::min(given_far, max_distance * kMargin) : 1;
  const double near =
      std::max(camera.near > 0 ? camera.near : far / kMaxFarNearRatio, min_distance / kMargin);
  if (!(near < far)) return {};
  const double h = camera.half_height > 0 ? camera.half_height : camera.half_width / aspect;
  const double w = h * aspect;
  try {
    return SceneCamera{.view = camera.view,
                       .projection = camera.is_orthographic
                                         ? orthographic(-w, w, -h, h, near, far)
                                         : frustum(-w * near, w * near, -h * near, h * near, near, far)};
  } catch (const Error&) {
    return {};  // the projection overflows or underflows
  }
}

std::array<double, 4> transformed(const Matrix& m, const std::array<double, 4>& v) {
  std::array<double, 4> r{};
  for (std::size_t row = 0; row < 4; ++row)
    for (std::size_t k = 0; k < 4; ++k) r[row] += m.m[4 * row + k] * v[k];
  return r;
}

/// Bit per plane of the view volume that a vertex lies beyond.
unsigned outcode(const Camera& camera, const float* p) {
  const std::array<double, 4> c =
      transformed(camera.projection, transformed(camera.view, {p[0], p[1], p[2], 1}));
  unsigned planes = 0;
  for (std::size_t k = 0; k < 3; ++k)
    planes |= (c[k] < -c[3] ? 1u << (2 * k) : 0u) | (c[k] > c[3] ? 2u << (2 * k) : 0u);
  return planes;
}

std::size_t corner_count(Primitive primitive) {
  if (primitive == Primitive::points) return 1;
  return primitive == Primitive::lines ? 2 : 3;
}

/// Tests outcodes: returns false only if each primitive lies wholly beyond one plane of the view volume.
bool any_primitive_in_view(const SceneCamera& camera, double aspect, const Model& model) {
  const Camera at = camera.at_aspect(aspect);
  const MeshData& mesh = model.mesh;
  for (const ModelPart& part : model.parts) {
    const std::size_t corners = corner_count(part.primitive), end = part.first_index + part.index_count;
    for (std::size_t i = part.first_index; i + corners <= end; i += corners) {
      unsigned shared = ~0u;
      for (std::size_t k = 0; k < corners; ++k)
        shared &= outcode(at, &mesh.positions[3 * std::size_t{mesh.indices[i + k]}]);
      if (shared == 0) return true;
    }
  }
  return false;
}

}  // namespace

std::optional<SceneCamera> camera_of_file(const Model& model, double aspect) {
  constexpr std::size_t kMaxTriedCameras = 16;  // each test costs a pass over the model
  for (std::size_t i = 0; i < std::min(model.cameras.size(), kMaxTriedCameras); ++i)
    if (const auto camera = camera_of_model(model.cameras[i], model.mesh, aspect);
        camera && any_primitive_in_view(*camera, aspect, model))
      return camera;
  return std::nullopt;
}

void choose_camera(const Model& model, double aspect, bool all_sides, Scene& scene) {
  scene.camera = framing_camera(model.mesh, aspect, all_sides, scene.name);
  if (all_sides || model.cameras.empty()) return;
  if (const auto camera = camera_of_file(model, aspect)) scene.camera = *camera;
  else
    scene.warnings.push_back(scene.name +
                             ": no camera of the file shows the model; a default camera frames it");
}

}  // namespace tessera::program
