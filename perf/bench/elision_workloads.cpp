#include "perf/bench/elision_workloads.h"

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "engine/program/scene/builtin_mesh.h"
#include "engine/program/scene/scene.h"
#include "perf/bench/drawn_workload.h"

namespace tessera::bench {
namespace {

struct Elision {
  const char* name;
  const char* description;
  Shading shading;
  std::function<void(Scene&, DrawState&)> change{};
  std::function<void(Scene&)> rearrange{};  ///< after `change`
};

/// Replaces the teapot by a square in front of the camera, with equal normals.
void show_square(Scene& scene) {
  MeshData& mesh = scene.meshes.front();
  mesh = builtin_mesh("grid", 100);
}

void add_lights(Scene& scene, const Light& light) { scene.lights.insert(scene.lights.end(), 60, light); }

Light spot_elsewhere() {
  Light light;
  light.position = {3, 1, 3, 1};
  light.spot_direction = {1, 0, 0};
  light.spot_cutoff = 20;
  return light;
}

Light point_behind() {
  Light light;
  light.position = {0.5f, 0, -3, 1};
  return light;
}

/// Adds seven teapots to the right of the view.
void add_draws_elsewhere(Scene& scene) {
  const SceneCommand last = scene.frame.back();
  for (int i = 0; i < 7; ++i) {
    scene.frame.push_back(last);
    if (auto* const draw = std::get_if<DrawCommand>(&scene.frame.back().value))
      draw->state.transform = translate(50, 0, 0) * draw->state.transform;
  }
}

/// Draws everything twice; the second time replaces the first.
void draw_twice(Scene& scene) {
  const std::vector<SceneCommand> once = scene.frame;
  scene.frame.insert(scene.frame.end(), once.begin(), once.end());
}

std::vector<Elision> elisions() {
  return {
      {"cones", "the lit teapot, 60 further spots that shine elsewhere", Shading::phong,
       [](Scene& scene, DrawState&) { add_lights(scene, spot_elsewhere()); }},
      {"behind", "a lit square, 60 further lights behind it", Shading::phong,
       [](Scene& scene, DrawState&) {
         show_square(scene);
         scene.lights.front().position[3] = 1;  // a point light, so that the square has no single colour
         add_lights(scene, point_behind());
       }},
      {"equal-normals", "a square under a directional light", Shading::phong,
       [](Scene& scene, DrawState&) {
         show_square(scene);
         scene.light_model.local_viewer = false;
       }},
      {"equal-colors", "an unlit square, all vertices white", Shading::gouraud,
       [](Scene& scene, DrawState& state) {
         show_square(scene);
         state.lighting = false;
         scene.meshes.front().colors.assign(4 * scene.meshes.front().vertex_count(), 1.0f);
       }},
      {"blend", "the lit teapot, blended with alpha 1", Shading::phong,
       [](Scene&, DrawState& state) { state.blend = BlendState{}; }},
      {"blend-gouraud", "the teapot lit at vertices, blended with alpha 1", Shading::gouraud,
       [](Scene&, DrawState& state) { state.blend = BlendState{}; }},
      {"alpha-test", "the lit teapot, an alpha test that every fragment passes", Shading::phong,
       [](Scene&, DrawState& state) { state.alpha_test = AlphaTest{}; }},
      {"outside", "the lit teapot, and seven more outside the view", Shading::gouraud,
       [](Scene&, DrawState&) {}, add_draws_elsewhere},
      {"never-read", "the lit teapot, cleared and drawn again", Shading::phong, [](Scene&, DrawState&) {},
       draw_twice},
  };
}

Drawing elision_drawing(int width, int height, const Elision& elision, bool in_full) {
  auto scene = std::make_shared<Scene>(builtin_scene());
  apply({.width = width, .height = height, .shading = elision.shading}, *scene);
  for (SceneCommand& command : scene->frame)
    if (auto* const draw = std::get_if<DrawCommand>(&command.value)) elision.change(*scene, draw->state);
  if (elision.rearrange) elision.rearrange(*scene);
  Drawing drawing;
  drawing.format = scene->framebuffer;
  drawing.meshes = scene->meshes;
  drawing.record = [scene](const Drawing&, Frame& frame) { record(*scene, frame); };
  drawing.runs_in_full = in_full;
  return drawing;
}

WorkloadEntry entry_of(const Elision& elision, bool in_full) {
  return drawn_outside_mean(std::string("elision-") + elision.name + (in_full ? "-in-full" : ""),
                            std::string(elision.description) + (in_full ? "; every effect runs" : ""),
                            [elision, in_full](int width, int height, std::uint32_t) {
                              return elision_drawing(width, height, elision, in_full);
                            });
}

}  // namespace

std::vector<WorkloadEntry> elision_workloads() {
  std::vector<WorkloadEntry> list;
  for (const Elision& elision : elisions()) {
    list.push_back(entry_of(elision, false));
    WorkloadEntry in_full = entry_of(elision, true);
    in_full.baseline = list.back().name;
    list.push_back(std::move(in_full));
  }
  return list;
}

}  // namespace tessera::bench
