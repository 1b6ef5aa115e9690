#include "perf/bench/elision_workloads.h"

#include <cmath>
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

/// Replaces the teapot by a dome, the part of z = -0.4 (x^2 + y^2) over the square.
void show_dome(Scene& scene) {
  show_square(scene);
  MeshData& mesh = scene.meshes.front();
  for (std::size_t i = 0; i < mesh.positions.size(); i += 3) {
    const float x = mesh.positions[i], y = mesh.positions[i + 1];
    const float length = std::sqrt(0.64f * (x * x + y * y) + 1);
    mesh.positions[i + 2] = -0.4f * (x * x + y * y);
    mesh.normals[i] = 0.8f * x / length;
    mesh.normals[i + 1] = 0.8f * y / length;
    mesh.normals[i + 2] = 1 / length;
  }
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

/// A light without a component that the material of show_green() reflects.
Light red_light() {
  Light light;
  light.position = {0.5f, 1, 3, 1};
  light.diffuse = light.specular = {1, 0, 0, 1};
  return light;
}
void show_green(DrawState& state) {
  for (auto* const color : {&state.material.ambient, &state.material.diffuse, &state.material.specular})
    *color = {0, color->g, 0, 1};
}

/// Puts a square in front of seven teapots.
void add_draws_behind(Scene& scene) {
  const SceneCommand last = scene.frame.back();
  auto* const front = std::get_if<DrawCommand>(&scene.frame.back().value);
  if (front == nullptr) return;
  scene.meshes.push_back(builtin_mesh("grid", 1));
  front->mesh = scene.meshes.size() - 1;
  front->state.transform = translate(0, 0, 1.5f) * scale(4, 4, 1);
  for (int i = 0; i < 7; ++i) scene.frame.push_back(last);
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
      {"hidden", "seven lit teapots behind a square", Shading::gouraud, [](Scene&, DrawState&) {},
       add_draws_behind},
  };
}

/// Lights that reach nothing. They should cost no more than their absence.
struct UselessLights {
  const char* name;
  const char* description;
  const char* useless;
  std::function<Light()> light;
  std::function<void(Scene&, DrawState&)> change;
};

std::vector<UselessLights> useless_lights() {
  return {
      {"cones", "the teapot", " and 60 spots that shine elsewhere", spot_elsewhere,
       [](Scene&, DrawState&) {}},
      {"dome", "a curved mesh", " and 60 behind it", point_behind,
       [](Scene& scene, DrawState&) { show_dome(scene); }},
      {"black", "a green teapot", " and 60 red ones", red_light,
       [](Scene&, DrawState& state) { show_green(state); }},
  };
}

/// Replaces the lights by four white point lights in front, and adds `useless` copies of another one.
void set_lights(Scene& scene, int useless, const Light& useless_light) {
  scene.lights.clear();
  for (const float x : {-2.0f, -1.0f, 1.0f, 2.0f}) {
    Light light;
    light.position = {x, 1.5f, 4, 1};
    light.diffuse = light.specular = {0.3f, 0.3f, 0.3f, 1};
    scene.lights.push_back(light);
  }
  scene.lights.insert(scene.lights.end(), static_cast<std::size_t>(useless), useless_light);
}

/// The built-in scene, changed, as a drawing.
Drawing changed_drawing(int width, int height, const Elision& elision) {
  auto scene = std::make_shared<Scene>(builtin_scene());
  apply({.width = width, .height = height, .shading = elision.shading}, *scene);
  for (SceneCommand& command : scene->frame)
    if (auto* const draw = std::get_if<DrawCommand>(&command.value)) elision.change(*scene, draw->state);
  if (elision.rearrange) elision.rearrange(*scene);
  Drawing drawing;
  drawing.format = scene->framebuffer;
  drawing.meshes = scene->meshes;
  drawing.record = [scene](const Drawing&, Frame& frame) { record(*scene, frame); };
  return drawing;
}

WorkloadEntry entry_of(const Elision& elision, bool in_full) {
  return drawn_outside_mean(std::string("elision-") + elision.name + (in_full ? "-in-full" : ""),
                            std::string(elision.description) + (in_full ? "; every effect runs" : ""),
                            [elision, in_full](int width, int height, std::uint32_t) {
                              Drawing drawing = changed_drawing(width, height, elision);
                              drawing.runs_in_full = in_full;
                              return drawing;
                            });
}

/// @param count  useless lights, besides the four others
WorkloadEntry entry_of(const UselessLights& lights, int count) {
  const std::string total = std::to_string(4 + count);
  return drawn_outside_mean(
      "elision-" + total + "-lights-" + lights.name,
      std::string(lights.description) + " under four lights" + (count == 0 ? "" : lights.useless),
      [lights, count](int width, int height, std::uint32_t) {
        return changed_drawing(
            width, height,
            {.name = lights.name,
             .description = lights.description,
             .shading = Shading::phong,
             .change = lights.change,
             .rearrange = [&](Scene& scene) { set_lights(scene, count, lights.light()); }});
      });
}

}  // namespace

std::vector<WorkloadEntry> elision_workloads() {
  std::vector<WorkloadEntry> list;
  const auto add_pair = [&](WorkloadEntry baseline, WorkloadEntry compared) {
    compared.baseline = baseline.name;
    list.push_back(std::move(baseline));
    list.push_back(std::move(compared));
  };
  for (const Elision& elision : elisions()) add_pair(entry_of(elision, false), entry_of(elision, true));
  for (const UselessLights& lights : useless_lights()) add_pair(entry_of(lights, 0), entry_of(lights, 60));
  return list;
}

}  // namespace tessera::bench
