#include "engine/program/scene/write_scene.h"

#include <cmath>
#include <filesystem>

#include "engine/program/imageio/atomic_file.h"
#include "engine/program/scene/json_text.h"
#include "engine/program/scene/state_names.h"
#include "engine/program/scene/write_parts.h"

namespace tessera::program {
namespace {

using json::Json;

Json vector_json(const Vec3& v) { return {v.x, v.y, v.z}; }

Json lens_json(const Lens& lens) {
  return {{"type", "perspective"},
          {"fovy", lens.fovy},
          {"near", lens.near},
          {"far", std::isinf(lens.far) ? Json("infinity") : Json(lens.far)}};
}

/// Matrices, unless viewpoint and lens are known.
Json camera_json(const Scene& scene) {
  const SceneCamera& camera = scene.camera;
  const auto* lens = std::get_if<Lens>(&camera.projection);
  if (camera.viewpoint && lens != nullptr)
    return {{"eye", vector_json(camera.viewpoint->eye)},
            {"target", vector_json(camera.viewpoint->target)},
            {"up", vector_json(camera.viewpoint->up)},
            {"projection", lens_json(*lens)}};
  const Camera at = camera.at_aspect(static_cast<double>(scene.framebuffer.width) / scene.framebuffer.height);
  return {{"view", at.view.m}, {"projection", at.projection.m}};
}

Json light_model_json(const LightModel& model) {
  return {{"ambient", color_json(model.ambient)},
          {"local_viewer", model.local_viewer},
          {"two_sided", model.two_sided},
          {"specular", name_in(kSpecularModels, model.specular)}};
}

Json light_json(const Light& light) {
  const float attenuation[] = {light.attenuation_constant, light.attenuation_linear,
                               light.attenuation_quadratic};
  Json json{{"ambient", color_json(light.ambient)},
            {"diffuse", color_json(light.diffuse)},
            {"specular", color_json(light.specular)},
            {"position", numbers_json(light.position)}};
  if (light.spot_cutoff != 180) {
    json["spot_direction"] = numbers_json(light.spot_direction);
    json["spot_exponent"] = json::number(light.spot_exponent);
    json["spot_cutoff"] = json::number(light.spot_cutoff);
  }
  if (light.position[3] != 0) json["attenuation"] = numbers_json(attenuation);
  return json;
}

Json lights_json(const LightList& lights) {
  Json list = Json::array();
  for (const Light& light : lights) list.push_back(light_json(light));
  return list;
}

Json scene_json(const Scene& scene, const std::vector<Json>& textures) {
  Json file{
      {"tessera", 1},
      {"title", std::filesystem::path(scene.title).filename().string()},
      {"framebuffer", {{"width", scene.framebuffer.width}, {"height", scene.framebuffer.height}}},
      {"camera", camera_json(scene)},
      {"light_model", light_model_json(scene.light_model)},
      {"lights", lights_json(scene.lights)},
  };
  DrawWriter draws(scene, textures);
  for (const SceneCommand& command : scene.frame) {
    if (const auto* clear = std::get_if<Clear>(&command.value)) draws.add(*clear);
    if (const auto* draw = std::get_if<DrawCommand>(&command.value)) draws.add(*draw);
  }
  draws.move_to(file);
  return file;
}

}  // namespace

Json numbers_json(std::span<const float> numbers) {
  Json list = Json::array();
  for (const float x : numbers) list.push_back(json::number(x));
  return list;
}

Json color_json(const Color& color) {
  const float components[] = {color.r, color.g, color.b, color.a};
  return numbers_json(components);
}

Json material_json(const Material& material) {
  return {{"ambient", color_json(material.ambient)},
          {"diffuse", color_json(material.diffuse)},
          {"specular", color_json(material.specular)},
          {"emission", color_json(material.emission)},
          {"shininess", json::number(material.shininess)}};
}

void write_scene(const Scene& scene, const std::string& path) {
  require_writable(path);
  const std::vector<Json> textures = write_textures(scene, path);
  write_file_atomically(path, json::readable_text(scene_json(scene, textures)));
}

}  // namespace tessera::program
