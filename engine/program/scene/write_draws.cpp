// Writes the draws of a frame, with their materials, textures and meshes.
#include <filesystem>

#include "engine/program/imageio/picture.h"
#include "engine/program/scene/json_text.h"
#include "engine/program/scene/state_names.h"
#include "engine/program/scene/write_parts.h"

namespace tessera::program {
namespace {

using json::Json;

/// Replaces invalid UTF-8, so that names that differ stay different in the file.
std::string valid_text(const std::string& text) {
  return Json::parse(Json(text).dump(-1, ' ', false, Json::error_handler_t::replace)).get<std::string>();
}

Json texture_json(const TextureSampler& sampler, const std::string& file) {
  return {{"file", file},
          {"mag", name_in(kTextureFilters, sampler.mag)},
          {"min", name_in(kTextureFilters, sampler.min)},
          {"wrap_s", name_in(kTextureWraps, sampler.wrap_s)},
          {"wrap_t", name_in(kTextureWraps, sampler.wrap_t)}};
}

/// State that differs from the defaults of the format.
void add_state(const DrawState& state, Json& json) {
  json["shading"] = name_in(kShadings, state.shading);
  if (!state.lighting) json["lighting"] = false;
  if (state.color_material != ColorMaterial::none)
    json["color_material"] = name_in(kColorMaterials, state.color_material);
  if (state.cull != Cull::none) json["cull"] = name_in(kCulls, state.cull);
  if (!state.depth.write) json["depth"] = {{"test", name_in(kCompares, state.depth.test)}, {"write", false}};
  if (state.alpha_test)
    json["alpha_test"] = {{"func", name_in(kCompares, state.alpha_test->func)},
                          {"ref", json::number(state.alpha_test->ref)}};
  if (state.blend)
    json["blend"] = {{"src", name_in(kBlendFactors, state.blend->src)},
                     {"dst", name_in(kBlendFactors, state.blend->dst)}};
}

}  // namespace

std::vector<Json> write_textures(const Scene& scene, const std::string& path) {
  const std::filesystem::path stem = std::filesystem::path(path).replace_extension();
  std::map<const Picture*, std::string> files;
  std::vector<Json> list;
  for (std::size_t i = 0; i < scene.textures.size(); ++i) {
    const Picture* picture = scene.texture_pictures[i].get();
    const std::string number = std::to_string(files.size());
    const auto [file, is_new] =
        files.emplace(picture, stem.filename().string() + ".texture" + number + ".png");
    if (is_new) write_png_with_alpha(*picture, stem.string() + ".texture" + number + ".png");
    list.push_back(texture_json(scene.textures[i]->sampler(), file->second));
  }
  return list;
}

std::string NamedList::add(const std::string& name, Json value) {
  const std::string given = valid_text(name);
  std::string unique = given;
  while (!names_.insert(unique).second) {
    int& number = last_number_.try_emplace(given, 1).first->second;
    unique = given + " " + std::to_string(++number);
  }
  members_.emplace_back(unique, std::move(value));
  return unique;
}

Json NamedList::take() {
  Json object = Json::object();
  auto& members = object.get_ref<Json::object_t&>();
  members.reserve(members_.size());  // ordered_json has constant keys: growing would copy all members
  for (auto& [name, value] : members_) members.emplace_back(name, std::move(value));
  members_.clear();
  return object;
}

DrawWriter::DrawWriter(const Scene& scene, const std::vector<Json>& textures) : scene_(scene) {
  for (std::size_t i = 0; i < textures.size(); ++i)
    texture_names_[scene.textures[i].get()] = textures_.add("texture" + std::to_string(i), textures[i]);
}

void DrawWriter::add(const Clear& clear) {
  Json json = Json::object();
  if (clear.color) json["color"] = color_json(*clear.color);
  if (clear.depth) json["depth"] = *clear.depth;
  if (clear.stencil) json["stencil"] = *clear.stencil;
  frame_.push_back({{"clear", json}});
}

void DrawWriter::add(const DrawCommand& draw) {
  std::optional<Json> mesh = mesh_json(draw, scene_);
  if (!mesh) return;
  const std::string& name = draw.material_name.empty() ? "mesh" : draw.material_name;
  Json json{{"draw", meshes_.add(name, std::move(*mesh))}, {"material", material_name(draw)}};
  if (draw.state.texture != nullptr) json["texture"] = texture_names_.at(draw.state.texture);
  add_state(draw.state, json);
  frame_.push_back(std::move(json));
}

std::string DrawWriter::material_name(const DrawCommand& draw) {
  Json material = material_json(draw.state.material);
  const auto [found, is_new] = names_of_materials_.try_emplace(material.dump());
  if (is_new)
    found->second =
        materials_.add(draw.material_name.empty() ? "material" : draw.material_name, std::move(material));
  return found->second;
}

void DrawWriter::move_to(Json& file) {
  if (!texture_names_.empty()) file["textures"] = textures_.take();
  file["materials"] = materials_.take();
  file["meshes"] = meshes_.take();
  file["frame"] = std::move(frame_);
}

}  // namespace tessera::program
