#include "engine/program/scene/model_scene.h"

#include <utility>

#include "engine/program/scene/follow_camera.h"
#include "engine/program/scene/model_camera.h"
#include "engine/program/scene/model_draws.h"
#include "engine/tessera/tessera.hpp"

namespace tessera::program {

Scene model_scene(Model model, const std::string& name, int width, int height, bool all_sides) {
  Scene scene{.name = name, .title = name};
  scene.framebuffer.width = width;
  scene.framebuffer.height = height;
  scene.light_model.local_viewer = true;
  scene.light_model.two_sided = true;  // models may have holes and wrongly wound faces
  scene.lights = model.lights;
  scene.is_model = true;
  scene.has_shoulder_light = model.lights.empty();
  if (model.ambient_light) scene.light_model.ambient = *model.ambient_light;
  scene.warnings = model.warnings;
  choose_camera(model, static_cast<double>(width) / height, all_sides, scene);
  scene.frame.push_back({Clear{.color = Color{0.18f, 0.2f, 0.25f, 1}, .depth = 1.0, .stencil = 0u}, ""});
  add_model_draws(std::move(model), scene);
  follow_camera(scene);
  return scene;
}

}  // namespace tessera::program
