#include "engine/program/scene/turntable.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "engine/program/scene/follow_camera.h"

namespace tessera::program {
namespace {

std::array<double, 3> in_world(const Matrix& m, const float* p) {
  std::array<double, 3> result{};
  for (std::size_t row = 0; row < 3; ++row)
    result[row] = m.m[4 * row] * p[0] + m.m[4 * row + 1] * p[1] + m.m[4 * row + 2] * p[2] + m.m[4 * row + 3];
  return result;
}

/// Centre of the bounds of all meshes that are drawn; vertices that are not finite are ignored.
Vec3 center_of(const Scene& scene) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  std::array<double, 3> low{kInfinity, kInfinity, kInfinity}, high{-kInfinity, -kInfinity, -kInfinity};
  for (const SceneCommand& command : scene.frame) {
    const auto* draw = std::get_if<DrawCommand>(&command.value);
    if (draw == nullptr) continue;
    const MeshData& mesh = scene.meshes[draw->mesh];
    const auto step = static_cast<std::size_t>(mesh.position_components);
    for (std::size_t i = 0; i + 2 < mesh.positions.size(); i += step) {
      const std::array<double, 3> p = in_world(draw->state.transform, &mesh.positions[i]);
      if (!std::isfinite(p[0] + p[1] + p[2])) continue;
      for (std::size_t k = 0; k < 3; ++k) {
        low[k] = std::min(low[k], p[k]);
        high[k] = std::max(high[k], p[k]);
      }
    }
    if (scene.blended && draw->mesh == scene.blended->mesh) break;  // its other draws have the same vertices
  }
  const auto middle = [&](std::size_t k) { return low[k] <= high[k] ? (low[k] + high[k]) / 2 : 0; };
  return {middle(0), middle(1), middle(2)};
}

/// The turn of the scene: rotation around the vertical axis through the centre.
Matrix turn_around(const Vec3& center, double degrees) {
  const SinCos angle = sin_cos_degrees(degrees);
  const double s = angle.sine, c = angle.cosine;
  const double x = center.x - c * center.x - s * center.z, z = center.z + s * center.x - c * center.z;
  return {{c, 0, s, x, 0, 1, 0, 0, -s, 0, c, z, 0, 0, 0, 1}};
}

template <std::size_t N>
void transform(const Matrix& m, double w, std::array<float, N>& v) {
  const std::array<double, 3> old{v[0], v[1], v[2]};
  for (std::size_t row = 0; row < 3; ++row)
    v[row] = static_cast<float>(m.m[4 * row] * old[0] + m.m[4 * row + 1] * old[1] +
                                m.m[4 * row + 2] * old[2] + m.m[4 * row + 3] * w);
}

void turn_camera(const Matrix& by, SceneCamera& camera) {
  camera.view = camera.view * by;
  camera.viewpoint.reset();
}

void turn_lights(const Matrix& by, LightList& lights) {
  for (Light& light : lights) {
    transform(by, static_cast<double>(light.position[3]), light.position);
    transform(by, 0, light.spot_direction);
  }
}

}  // namespace

void turn_viewer(double degrees, Scene& scene) {
  const Vec3 center = center_of(scene);
  const Matrix turn = turn_around(center, degrees), back = turn_around(center, -degrees);
  turn_camera(turn, scene.camera);
  turn_lights(back, scene.lights);
  for (SceneCommand& command : scene.frame) {
    if (auto* camera = std::get_if<SceneCamera>(&command.value)) turn_camera(turn, *camera);
    if (auto* lights = std::get_if<LightList>(&command.value)) turn_lights(back, *lights);
  }
  follow_camera(scene);
}

}  // namespace tessera::program
