#include "engine/program/import/obj_materials.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <sstream>
#include <tuple>
#include <utility>

#include "engine/program/scene/text_file.h"

namespace tessera::program {
namespace {

namespace fs = std::filesystem;

constexpr float kMaxShininess = 16384;

bool is_black(const Rgb& color) { return color == Rgb{0, 0, 0}; }

/// The files that a mtllib line names: one name, which may hold spaces, or several separated by spaces.
std::vector<std::string> named_files(const std::string& names, const std::string& folder) {
  if (names.find_first_of(" \t\\") == names.npos) return {names};
  const auto paths = possible_paths(names);
  for (const std::string& path : paths) {
    std::error_code invalid_name;  // such as one that is too long
    if (fs::exists(fs::path(folder) / path, invalid_name)) return {path};
  }
  std::vector<std::string> files;
  std::istringstream several(paths[0]);
  for (std::string name; several >> name;) files.push_back(name);
  return files;
}

/// Warnings of a model without repetitions, at most 20, each with the name of the OBJ file.
class Warnings {
 public:
  Warnings(const std::string& path, std::vector<std::string>& lines) : path_(path), lines_(lines) {}

  void add(const std::string& text) {
    constexpr std::size_t kMaxWarnings = 20;
    const std::string line = path_ + ": " + text;
    if (lines_.size() < kMaxWarnings && std::ranges::find(lines_, line) == lines_.end())
      lines_.push_back(line);
  }

 private:
  const std::string& path_;
  std::vector<std::string>& lines_;
};

/// Where a material is defined.
struct Definition {
  const std::vector<MtlMaterial>* file = nullptr;
  const MtlMaterial* material = nullptr;
};

/// The materials of all files; the first definition of a name counts.
class Library {
 public:
  Library(const std::vector<std::string>& names_of_files, const std::string& folder, Warnings& warnings) {
    std::vector<std::string> files;
    for (const std::string& names : names_of_files)
      for (const std::string& name : named_files(names, folder))
        if (std::ranges::find(files, name) == files.end()) files.push_back(name);
    files_.reserve(files.size());
    for (const std::string& name : files) read(folder, name, warnings);
  }

  const Definition* find(const std::string& name) const {
    const auto found = by_name_.find(name);
    return found == by_name_.end() ? nullptr : &found->second;
  }

 private:
  void read(const std::string& folder, const std::string& name, Warnings& warnings) {
    const std::string path = (fs::path(folder) / name).string();
    std::string text;
    try {
      refuse_device_or_pipe(path);
      text = read_text_file(path);
    } catch (const Error& missing) {
      return warnings.add(std::string(missing.what()) + "; materials get default colors");
    }
    std::vector<std::string> lines;
    std::vector<MtlMaterial>& file = files_.emplace_back(parse_mtl(text, path, lines));
    for (const std::string& line : lines) warnings.add(line);
    // Images are relative to the material file, but ModelImage::name to the model.
    for (MtlMaterial& material : file)
      for (MtlMap* map : {&material.diffuse_map, &material.opacity_map})
        if (!map->image.empty()) map->image = (fs::path(name).parent_path() / map->image).string();
    for (const MtlMaterial& material : file)
      by_name_.try_emplace(material.name, Definition{&file, &material});
  }

  std::vector<std::vector<MtlMaterial>> files_;
  std::map<std::string, Definition> by_name_;
};

/// Adds images and textures to a model, each of them once.
class Textures {
 public:
  explicit Textures(Model& model) : model_(model) {}

  /// The texture of map_Kd and map_d together; the options are those of map_Kd.
  std::optional<std::size_t> of(const MtlMaterial& material) {
    const MtlMap& map = map_of(material);
    if (map.image.empty()) return std::nullopt;
    const auto image = added(images_, std::pair(material.diffuse_map.image, material.opacity_map.image),
                             model_.images, [&](ModelImage& to) {
                               to.name = material.diffuse_map.image;
                               to.alpha_name = material.opacity_map.image;
                             });
    return added(textures_, std::pair(image, map.is_clamped), model_.textures, [&](ModelTexture& to) {
      to.image = image;
      if (map.is_clamped) to.sampler.wrap_s = to.sampler.wrap_t = TextureWrap::clamp_to_edge;
    });
  }

  static const MtlMap& map_of(const MtlMaterial& material) {
    return material.diffuse_map.image.empty() ? material.opacity_map : material.diffuse_map;
  }

 private:
  template <class Key, class Element, class Fill>
  static std::size_t added(std::map<Key, std::size_t>& known, const Key& key, std::vector<Element>& list,
                           const Fill& fill) {
    const auto [entry, is_new] = known.try_emplace(key, list.size());
    if (is_new) fill(list.emplace_back());
    return entry->second;
  }

  Model& model_;
  std::map<std::pair<std::string, std::string>, std::size_t> images_;
  std::map<std::pair<std::size_t, bool>, std::size_t> textures_;
};

ObjMaterial converted(const Definition& from, Textures& textures, Warnings& warnings) {
  const MtlMaterial& mtl = *from.material;
  const float shininess = mtl.shininess.value_or(0);
  if (shininess < 0 || shininess > kMaxShininess)
    warnings.add("Ns of material \"" + mtl.name + "\" is " + std::to_string(shininess) +
                 ", clamped to 0 .. 16384");
  ObjMaterial material{.name = mtl.name,
                       .material = material_of(mtl, alpha_of(mtl, *from.file)),
                       .texture = textures.of(mtl),
                       .texcoord_scale = Textures::map_of(mtl).scale,
                       .texcoord_offset = Textures::map_of(mtl).offset};
  if (material.material.diffuse.a < 1 || !mtl.opacity_map.image.empty()) material.alpha = ModelAlpha::blend;
  return material;
}

}  // namespace

std::vector<std::optional<ObjMaterial>> obj_materials(const ObjFile& file, const std::string& path,
                                                      Model& model) {
  Warnings warnings(path, model.warnings);
  const Library library(file.material_files, fs::path(path).parent_path().string(), warnings);
  Textures textures(model);
  std::vector<std::optional<ObjMaterial>> materials;
  for (const std::string& name : file.material_names) {
    const Definition* const definition = library.find(name);
    materials.emplace_back();
    if (definition != nullptr) materials.back() = converted(*definition, textures, warnings);
    else warnings.add("material \"" + name + "\" is not defined");
  }
  return materials;
}

float alpha_of(const MtlMaterial& material, const std::vector<MtlMaterial>& file) {
  if (material.opacity) return *material.opacity;
  if (!material.transparency) return 1;
  const auto some_has = [&](float transparency) {
    return std::ranges::any_of(
        file, [&](const MtlMaterial& m) { return !m.opacity && m.transparency == transparency; });
  };
  const bool is_opacity = some_has(1) && !some_has(0);
  return is_opacity ? *material.transparency : 1 - *material.transparency;
}

Material material_of(const MtlMaterial& from, float alpha) {
  const auto color = [](const Rgb& rgb, float a) { return Color{rgb[0], rgb[1], rgb[2], a}; };
  constexpr Rgb kBlack{0, 0, 0};
  const Color standard = Material{}.diffuse;
  const bool has_map = !from.diffuse_map.image.empty();
  Rgb diffuse = from.diffuse.value_or(has_map ? kBlack : Rgb{standard.r, standard.g, standard.b});
  Rgb ambient = from.ambient.value_or(diffuse);
  if (has_map && is_black(diffuse)) {
    diffuse = {1, 1, 1};
    if (is_black(ambient)) ambient = diffuse;
  }
  const float shininess = std::clamp(from.shininess.value_or(0), 0.0f, kMaxShininess);
  const bool has_highlight = from.illum.value_or(2) >= 2 && shininess > 0;
  return {.ambient = color(ambient, 1),
          .diffuse = color(diffuse, alpha),
          .specular = color(has_highlight ? from.specular.value_or(kBlack) : kBlack, 1),
          .emission = color(from.emission.value_or(kBlack), 1),
          .shininess = shininess};
}

std::array<std::string, 2> possible_paths(const std::string& name) {
  std::string with_slashes;
  std::string unescaped;
  for (std::size_t i = 0; i < name.size(); ++i) {
    const bool before_space = name[i] == '\\' && i + 1 < name.size() && name[i + 1] == ' ';
    if (!before_space) with_slashes += name[i] == '\\' ? '/' : name[i];
  }
  for (std::size_t i = 0; i < name.size(); ++i) {
    if (name[i] == '\\' && i + 1 < name.size()) ++i;
    unescaped += name[i];
  }
  return {with_slashes, unescaped};
}

}  // namespace tessera::program
