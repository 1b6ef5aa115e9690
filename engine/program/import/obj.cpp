// Uses tinyobjloader on text that obj_text.h has rewritten and obj_check.h has checked.
#include <algorithm>
#include <filesystem>
#include <map>
#include <sstream>
#include <unordered_map>
#include <utility>

#include <tiny_obj_loader.h>

#include "engine/program/import/obj.h"
#include "engine/program/import/obj_check.h"
#include "engine/program/import/obj_text.h"
#include "engine/program/scene/text_file.h"

namespace tessera::program {
namespace {

/// Reads material files, relative to the folder of the model. A missing one is a warning.
class MaterialFiles : public tinyobj::MaterialReader {
 public:
  explicit MaterialFiles(std::string folder) : folder_(std::move(folder)) {}

  /// Returns the keys that the MTL file gives for `material`.
  MtlKeys given(const std::string& material) const {
    const auto found = given_.find(material);
    return found == given_.end() ? MtlKeys{} : found->second;
  }

  /// `names` is one name, which may hold spaces, or several names separated by spaces.
  bool operator()(const std::string& names, std::vector<tinyobj::material_t>* materials,
                  std::map<std::string, int>* by_name, std::string* warning, std::string* error) override {
    const auto paths = possible_paths(names);
    for (const std::string& path : paths) {
      std::error_code invalid_name;  // such as one that is too long
      if (path == names || std::filesystem::exists(std::filesystem::path(folder_) / path, invalid_name))
        return read(path, materials, by_name, warning, error);
    }
    bool is_read = false;
    std::istringstream several(paths[0]);
    for (std::string name; several >> name;) is_read |= read(name, materials, by_name, warning, error);
    return is_read;
  }

 private:
  bool read(const std::string& name, std::vector<tinyobj::material_t>* materials,
            std::map<std::string, int>* by_name, std::string* warning, std::string* error) {
    const std::string path = (std::filesystem::path(folder_) / name).string();
    std::string text;
    try {
      refuse_device_or_pipe(path);
      text = read_text_file(path);
    } catch (const Error& missing) {
      *warning += std::string(missing.what()) + "\n";
      return false;
    }
    std::vector<std::string> warnings;
    text = normalized_mtl(text, path, warnings);
    given_.merge(check_mtl(text, path));
    std::istringstream stream(text);
    std::string more;  // LoadMtl overwrites its warnings
    tinyobj::LoadMtl(by_name, materials, &stream, &more, error);
    for (const std::string& line : warnings) *warning += line + "\n";
    *warning += more;
    return true;
  }

  std::string folder_;
  std::map<std::string, MtlKeys, std::less<>> given_;
};

/// Replaces the black that tinyobjloader leaves for colours that the file does not give: diffuse by the
/// default, ambient by the diffuse colour. Materials with illum below 2 have no highlight.
void fill_in(tinyobj::material_t& material, const MtlKeys& given, std::string& warning) {
  const Color diffuse = Material{}.diffuse;
  const float standard[3] = {diffuse.r, diffuse.g, diffuse.b};
  if (!given.diffuse) std::copy_n(standard, 3, material.diffuse);
  if (!given.ambient) std::copy_n(material.diffuse, 3, material.ambient);
  if (given.illum && material.illum < 2) std::fill_n(material.specular, 3, 0.0f);
  material.name = with_spaces(material.name);
  if (given.texture)
    warning +=
        "map_Kd of material \"" + material.name + "\" is left out: textures of models are not supported\n";
  if (given.dissolve && material.dissolve < 1)
    warning += "d of material \"" + material.name + "\" is left out: transparency is not supported\n";
}

struct Obj {
  tinyobj::attrib_t attributes;
  std::vector<tinyobj::shape_t> shapes;
  std::vector<tinyobj::material_t> materials;
  std::vector<std::string> warnings;
};

/// Splits the text into lines without repetitions, at most 20.
std::vector<std::string> warning_lines(const std::string& text, const std::string& path) {
  constexpr std::size_t kMaxWarnings = 20;
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line) && lines.size() < kMaxWarnings;) {
    const std::string warning = path + ": " + line;
    if (!line.empty() && std::find(lines.begin(), lines.end(), warning) == lines.end())
      lines.push_back(warning);
  }
  return lines;
}

Obj load(const std::string& path) {
  const std::string text = normalized_obj(read_text_file(path));
  check_obj(text, path);
  Obj obj;
  MaterialFiles material_files(std::filesystem::path(path).parent_path().string());
  std::istringstream stream(text);
  std::string warning;
  std::string error;
  constexpr bool kTriangulate = true;
  constexpr bool kWhiteIfUncolored = false;
  if (!tinyobj::LoadObj(&obj.attributes, &obj.shapes, &obj.materials, &warning, &error, &stream,
                        &material_files, kTriangulate, kWhiteIfUncolored)) {
    error.erase(std::remove(error.begin(), error.end(), '\n'), error.end());
    throw Error(path + ": " + (error.empty() ? "is not an OBJ file" : error));
  }
  for (tinyobj::material_t& material : obj.materials)
    fill_in(material, material_files.given(material.name), warning);
  obj.warnings = warning_lines(warning, path);
  return obj;
}

/// Attributes that every corner of a file has.
struct CornerAttributes {
  bool normals = false;
  bool texcoords = false;
};

/// Turns corners (position, normal, texture coordinates) into vertices of one mesh.
class VertexPool {
 public:
  VertexPool(const tinyobj::attrib_t& attributes, CornerAttributes given, MeshData& mesh)
      : attributes_(attributes),
        has_normals_(given.normals),
        has_texcoords_(given.texcoords),
        has_colors_(attributes.colors.size() == attributes.vertices.size()),
        mesh_(mesh) {}

  std::uint32_t vertex(tinyobj::index_t corner) {
    const auto position = static_cast<std::uint32_t>(corner.vertex_index);
    const auto normal = static_cast<std::uint32_t>(has_normals_ ? corner.normal_index : 0);
    const auto texcoord = static_cast<std::uint32_t>(has_texcoords_ ? corner.texcoord_index : 0);
    const auto [entry, is_new] = vertices_.try_emplace({std::uint64_t{position} << 32 | normal, texcoord},
                                                       static_cast<std::uint32_t>(vertices_.size()));
    if (is_new) {
      if (has_texcoords_)
        for (std::size_t k = 0; k < 2; ++k)
          mesh_.texcoords.push_back(attributes_.texcoords.at(2 * std::size_t{texcoord} + k));
      append(attributes_.vertices, position, mesh_.positions);
      if (has_normals_) append(attributes_.normals, normal, mesh_.normals);
      if (has_colors_) {
        append(attributes_.colors, position, mesh_.colors);
        mesh_.colors.push_back(1);
      }
    }
    return entry->second;
  }

 private:
  static void append(const std::vector<tinyobj::real_t>& from, std::size_t index, std::vector<float>& to) {
    to.insert(to.end(), {from.at(3 * index), from.at(3 * index + 1), from.at(3 * index + 2)});
  }

  using Key = std::pair<std::uint64_t, std::uint32_t>;  // (position << 32 | normal, texture coordinates)
  struct Hash {
    std::size_t operator()(const Key& key) const {
      return static_cast<std::size_t>((key.first ^ key.second * 0x9e3779b97f4a7c15u) * 0xff51afd7ed558ccdu >>
                                      16);
    }
  };

  const tinyobj::attrib_t& attributes_;
  bool has_normals_;
  bool has_texcoords_;
  bool has_colors_;
  MeshData& mesh_;
  std::unordered_map<Key, std::uint32_t, Hash> vertices_;
};

Material material_from_mtl(const tinyobj::material_t& from, std::vector<std::string>& warnings,
                           const std::string& path) {
  const auto color = [](const tinyobj::real_t(&rgb)[3], float alpha) {
    return Color{rgb[0], rgb[1], rgb[2], alpha};
  };
  constexpr float kMaxShininess = 16384;
  if (from.shininess < 0 || from.shininess > kMaxShininess)
    warnings.push_back(path + ": Ns of material \"" + from.name + "\" is " + std::to_string(from.shininess) +
                       ", clamped to 0 .. 16384");
  return {.ambient = color(from.ambient, 1),
          .diffuse = color(from.diffuse, from.dissolve),
          .specular = color(from.specular, 1),
          .emission = color(from.emission, 1),
          .shininess = std::clamp(from.shininess, 0.0f, kMaxShininess)};
}

/// @throws Error if the file has no corners
CornerAttributes shared_attributes(const Obj& obj, const std::string& path,
                                   std::vector<std::string>& warnings) {
  std::size_t corners = 0;
  std::size_t corners_with_normal = 0;
  std::size_t corners_with_texcoord = 0;
  const auto texcoords = static_cast<std::int64_t>(obj.attributes.texcoords.size() / 2);
  for (const tinyobj::shape_t& shape : obj.shapes)
    for (const tinyobj::index_t& corner : shape.mesh.indices) {
      ++corners;
      corners_with_normal += corner.normal_index >= 0 ? 1 : 0;
      corners_with_texcoord += corner.texcoord_index >= 0 && corner.texcoord_index < texcoords ? 1 : 0;
    }
  if (corners == 0) throw Error(path + ": holds no triangle");
  const CornerAttributes shared{.normals = corners_with_normal == corners,
                                .texcoords = corners_with_texcoord == corners};
  if (!shared.normals && corners_with_normal > 0)
    warnings.push_back(path + ": only some corners have normals; all normals are generated");
  if (!shared.texcoords && corners_with_texcoord > 0)
    warnings.push_back(path + ": only some corners have texture coordinates; none are used");
  return shared;
}

/// Triangles of one material.
struct Group {
  int material_id = -1;  ///< index in Obj::materials; -1: none
  std::vector<std::uint32_t> indices;
};

/// Groups triangles by material, in the order of first use.
std::vector<Group> grouped_by_material(const Obj& obj, VertexPool& pool) {
  std::vector<Group> groups;
  std::map<int, std::size_t> group_of;
  for (const tinyobj::shape_t& shape : obj.shapes)
    for (std::size_t face = 0; face < shape.mesh.material_ids.size(); ++face) {
      const int material_id = shape.mesh.material_ids[face];
      const auto [group, is_new] = group_of.try_emplace(material_id, groups.size());
      if (is_new) groups.push_back({material_id, {}});
      for (std::size_t k = 0; k < 3; ++k)
        groups[group->second].indices.push_back(pool.vertex(shape.mesh.indices[3 * face + k]));
    }
  return groups;
}

}  // namespace

Model import_obj(const std::string& path) {
  Obj obj = load(path);
  Model model{.warnings = std::move(obj.warnings)};
  VertexPool pool(obj.attributes, shared_attributes(obj, path, model.warnings), model.mesh);
  for (const auto& [id, indices] : grouped_by_material(obj, pool)) {
    ModelPart part{.material_name = {},
                   .material = {},
                   .first_index = model.mesh.indices.size(),
                   .index_count = indices.size(),
                   .uses_colors = id < 0 && !model.mesh.colors.empty()};
    if (id >= 0) {
      part.material_name = obj.materials.at(static_cast<std::size_t>(id)).name;
      part.material = material_from_mtl(obj.materials[static_cast<std::size_t>(id)], model.warnings, path);
    }
    model.parts.push_back(std::move(part));
    model.mesh.indices.insert(model.mesh.indices.end(), indices.begin(), indices.end());
  }
  return model;
}

}  // namespace tessera::program
