#include "engine/program/scene/follow_camera.h"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace tessera::program {
namespace {

/// Direction of the light over the viewer's left shoulder: right, up, towards the viewer.
constexpr double kShoulder[3] = {-0.14, 0.53, 0.84};

/// The direction in world space. The rotation of a view is inverted by its transpose.
Light shoulder_light(const Matrix& view) {
  Light light;
  for (std::size_t column = 0; column < 3; ++column) {
    double sum = 0;
    for (std::size_t row = 0; row < 3; ++row) sum += view.m[4 * row + column] * kShoulder[row];
    light.position[column] = static_cast<float>(sum);
  }
  light.position[3] = 0;
  return light;
}

/// Distance of a triangle's centre along the direction of view, three times.
double distance_of(const std::uint32_t* corners, const std::vector<float>& positions, const Matrix& view) {
  const double* row = &view.m[8];  // eye z; the viewer looks along -z
  double z = 0;
  for (std::size_t corner = 0; corner < 3; ++corner) {
    const float* p = &positions[3 * std::size_t{corners[corner]}];
    z += row[0] * p[0] + row[1] * p[1] + row[2] * p[2];
  }
  return -z;
}

void sort_blended(BlendedTriangles& blended, Scene& scene) {
  MeshData& mesh = scene.meshes[blended.mesh];
  const std::size_t count = blended.draw_of.size();
  std::vector<double> distance(count);
  for (std::size_t i = 0; i < count; ++i)
    distance[i] = distance_of(&blended.indices[3 * i], mesh.positions, scene.camera.view);
  std::vector<std::uint32_t> order(count);
  std::iota(order.begin(), order.end(), 0u);
  // Not a number compares false with everything, which is no order: such triangles are not drawn anyway.
  for (double& d : distance) d = d == d ? d : 0;
  std::ranges::stable_sort(order,
                           [&](std::uint32_t a, std::uint32_t b) { return distance[a] > distance[b]; });

  std::erase_if(scene.frame, [&](const SceneCommand& command) {
    const auto* draw = std::get_if<DrawCommand>(&command.value);
    return draw != nullptr && draw->mesh == blended.mesh;
  });
  mesh.indices.clear();
  std::size_t run_begin = 0;  // consecutive triangles of one draw
  for (std::size_t i = 0; i < count; ++i) {
    mesh.indices.insert(mesh.indices.end(), &blended.indices[3 * std::size_t{order[i]}],
                        &blended.indices[3 * std::size_t{order[i]}] + 3);
    const std::uint32_t number = blended.draw_of[order[i]];
    if (i + 1 < count && blended.draw_of[order[i + 1]] == number) continue;
    DrawCommand draw = blended.draws[number];
    draw.first_index = 3 * run_begin;
    draw.index_count = 3 * (i + 1 - run_begin);
    scene.frame.push_back({draw, ""});
    run_begin = i + 1;
  }
}

}  // namespace

void follow_camera(Scene& scene) {
  if (scene.has_shoulder_light) scene.lights = {shoulder_light(scene.camera.view)};
  if (scene.blended) sort_blended(*scene.blended, scene);
}

}  // namespace tessera::program
