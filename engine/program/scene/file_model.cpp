#include "engine/program/scene/file_model.h"

#include <filesystem>
#include <utility>

#include "engine/program/scene/model_camera.h"
#include "engine/program/scene/model_draws.h"
#include "engine/program/scene/read_scene.h"

namespace tessera::program {
namespace {

using json::Value;

std::string name_of(const ModelPart& part, std::size_t number) {
  return part.material_name.empty() ? "part " + std::to_string(number) : part.material_name;
}

/// Splits the model into parts and moves them back to where the file has them.
FileModel split(Model model) {
  FileModel split;
  std::vector<DrawCommand> blended;
  std::vector<std::shared_ptr<const Picture>> pictures;
  split.textures = make_textures(model, pictures);
  const Matrix to_file = translate(model.origin.x, model.origin.y, model.origin.z);
  split.meshes = split_into_parts(model);
  for (std::size_t i = 0; i < model.parts.size(); ++i) {
    ModelPart& part = model.parts[i];
    MeshData& mesh = split.meshes[i];
    mesh.primitive = part.primitive;
    mesh.name = name_of(part, i);
    if (part.alpha == ModelAlpha::blend && !has_alpha(part, mesh, model)) part.alpha = ModelAlpha::opaque;
    if (!part.uses_colors) mesh.colors.clear();
    const Texture* const texture = part.texture ? split.textures[*part.texture].get() : nullptr;
    DrawCommand draw{.mesh = i, .state = part_state(part, texture), .material_name = part.material_name};
    draw.state.transform = to_file;
    (draw.state.blend ? blended : split.draws).push_back(std::move(draw));
  }
  split.draws.insert(split.draws.end(), blended.begin(), blended.end());
  split.model = std::move(model);
  return split;
}

std::string path_of(const Value& file, const std::string& base_folder) {
  return (std::filesystem::path(base_folder) / file.text()).string();
}

/// The elements of the model's first kind of primitive.
MeshData mesh_of(const Model& model) {
  MeshData mesh = model.mesh;
  mesh.primitive = model.parts.front().primitive;
  mesh.indices.clear();
  for (const ModelPart& part : model.parts) {
    if (part.primitive != mesh.primitive) continue;
    const auto first = model.mesh.indices.begin() + static_cast<std::ptrdiff_t>(part.first_index);
    mesh.indices.insert(mesh.indices.end(), first, first + static_cast<std::ptrdiff_t>(part.index_count));
  }
  const double origin[] = {model.origin.x, model.origin.y, model.origin.z};
  for (std::size_t i = 0; i < mesh.positions.size(); ++i)
    mesh.positions[i] = static_cast<float>(mesh.positions[i] + origin[i % 3]);
  return mesh;
}

}  // namespace

const FileMesh& file_mesh(const Value& file, const std::string& base_folder, FileCache& cache) {
  const std::string path = path_of(file, base_folder);
  auto known = cache.meshes.find(path);
  if (known == cache.meshes.end()) {
    const Model model = file.checked([&] { return import_model(path, ModelUse::mesh, cache.import); });
    known = cache.meshes.emplace(path, FileMesh{mesh_of(model), model.warnings}).first;
  }
  return known->second;
}

const FileModel& file_model(const Value& file, const std::string& base_folder, FileCache& cache) {
  const std::string path = path_of(file, base_folder);
  auto known = cache.models.find(path);
  if (known == cache.models.end()) {
    Model model = file.checked([&] { return import_model(path, ModelUse::display, cache.import); });
    known = cache.models.emplace(path, split(std::move(model))).first;
  }
  return known->second;
}

SceneCamera file_camera(const Value& file, const std::string& base_folder, double aspect, FileCache& cache) {
  const Model& model = file_model(file, base_folder, cache).model;
  std::optional<SceneCamera> camera = camera_of_file(model, aspect);
  if (!camera) file.fail("a model file with a camera that shows the model");
  camera->view = camera->view * translate(-model.origin.x, -model.origin.y, -model.origin.z);
  return *camera;
}

LightList file_lights(const Value& file, const std::string& base_folder, FileCache& cache) {
  const Model& model = file_model(file, base_folder, cache).model;
  if (model.lights.empty()) file.fail("a model file with lights");
  LightList lights = model.lights;
  const double origin[] = {model.origin.x, model.origin.y, model.origin.z};
  for (Light& light : lights)
    for (std::size_t k = 0; k < 3; ++k)
      if (light.position[3] != 0) light.position[k] = static_cast<float>(light.position[k] + origin[k]);
  return lights;
}

DrawCommand with_file_state(const DrawCommand& draw, const DrawCommand& of_file, const GivenState& given,
                            bool can_blend) {
  DrawCommand combined = draw;
  DrawState& state = combined.state;
  const DrawState& from = of_file.state;
  combined.mesh = of_file.mesh;
  state.transform = state.transform * from.transform;
  combined.material_name = of_file.material_name;
  state.material = from.material;
  if (!given.texture) state.texture = from.texture;
  if (!given.lighting) state.lighting = from.lighting;
  if (!given.color_material) state.color_material = from.color_material;
  if (!given.cull) state.cull = from.cull;
  if (!can_blend) return combined;
  if (!given.alpha_test) state.alpha_test = from.alpha_test;
  if (given.blend || !from.blend) return combined;
  state.blend = from.blend;
  if (!given.depth) state.depth.write = false;
  return combined;
}

}  // namespace tessera::program
