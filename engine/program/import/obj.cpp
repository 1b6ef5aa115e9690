#include "engine/program/import/obj.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <span>
#include <utility>

#include "engine/program/import/model_normals.h"
#include "engine/program/import/model_origin.h"
#include "engine/program/import/obj_file.h"
#include "engine/program/import/obj_materials.h"
#include "engine/program/import/obj_vertices.h"
#include "engine/program/import/polygon_split.h"
#include "engine/program/scene/text_file.h"

namespace tessera::program {
namespace {

using Materials = std::vector<std::optional<ObjMaterial>>;

/// Makes a point of each vertex of a file without elements.
void add_points_of_lone_vertices(ObjFile& file) {
  const auto count = static_cast<std::uint32_t>(file.positions.size());
  if (!file.elements.empty() || count == 0) return;
  for (std::uint32_t i = 0; i < count; ++i) file.corners.push_back({.position = i});
  file.elements.push_back({.primitive = Primitive::points, .corner_count = count});
}

/// Forgets normals of length 0, and returns whether a corner of a face has another.
bool keep_usable_normals(ObjFile& file) {
  for (ObjCorner& corner : file.corners)
    if (corner.normal >= 0 && is_missing_normal(&file.normals[3 * static_cast<std::size_t>(corner.normal)]))
      corner.normal = kNoObjIndex;
  std::size_t first = 0;
  for (const ObjElement& element : file.elements) {
    for (std::size_t i = first; i < first + element.corner_count; ++i)
      if (element.primitive == Primitive::polygon && file.corners[i].normal >= 0) return true;
    first += element.corner_count;
  }
  return false;
}

/// As origin_for(), for the positions that elements use.
Vec3 origin_of(const ObjFile& file) {
  std::vector<bool> is_used(file.positions.size(), false);
  for (const ObjCorner& corner : file.corners) is_used[corner.position] = true;
  std::vector<std::array<double, 3>> used;
  for (std::size_t i = 0; i < is_used.size(); ++i)
    if (is_used[i]) used.push_back(file.positions[i]);
  return used.empty() ? Vec3{} : origin_for(used);
}

std::vector<float> floats(const std::vector<std::array<double, 3>>& positions, const Vec3& origin) {
  std::vector<float> numbers;
  append_relative(positions, origin, numbers);
  return numbers;
}

/// Elements of one material and primitive.
struct Group {
  int material = -1;  ///< index into Materials; -1: none
  std::vector<std::uint32_t> indices;
  std::vector<std::uint32_t> smoothing_groups;  ///< one per triangle
  bool has_color = false;                       ///< some vertex has a colour
  bool lacks_texcoords = false;                 ///< some corner has none
};

class Builder {
 public:
  Builder(ObjFile& file, const Materials& materials, ModelUse use, const ReportProgress& progress,
          Model& model)
      : file_(file),
        materials_(materials),
        use_(use),
        progress_(progress),
        model_(model),
        positions_(floats(file.positions, model.origin)),
        attributes_(attributes()),
        vertices_(file, positions_, attributes_, model.mesh) {}

  void add_triangles() {
    std::vector<Group> groups = grouped(Primitive::polygon, part_of(progress_, 0, 0.6));
    std::vector<std::uint32_t> smoothing_groups;
    for (Group& group : groups)
      smoothing_groups.insert(smoothing_groups.end(), group.smoothing_groups.begin(),
                              group.smoothing_groups.end());
    for (Group& group : groups) add_part(std::move(group), Primitive::triangles);
    if (attributes_.normals && lacks_normals())
      add_creased_normals(model_.mesh, kCreaseDegrees,
                          file_.has_smoothing_groups ? smoothing_groups : std::span<const std::uint32_t>(),
                          part_of(progress_, 0.6, 1));
  }

  void add_lines() {
    for (Group& group : grouped(Primitive::line_strip, {})) add_part(std::move(group), Primitive::lines);
  }
  void add_points() {
    for (Group& group : grouped(Primitive::points, {})) add_part(std::move(group), Primitive::points);
  }

  /// Warns of corners without texture coordinates that may need some.
  void warn_of_texcoords(const std::string& path) {
    for (std::size_t i = 0; i < model_.parts.size() && use_ == ModelUse::display; ++i)
      if (model_.parts[i].texture && lacks_texcoords_[i])
        model_.warnings.push_back(
            path + ": material \"" + model_.parts[i].material_name +
            "\" has a texture, but some corners have no texture coordinates; they get 0, 0");
    if (use_ == ModelUse::mesh && attributes_.texcoords && std::ranges::count(lacks_texcoords_, true) > 0)
      model_.warnings.push_back(path + ": only some corners have texture coordinates; the others get 0, 0");
  }

 private:
  ObjAttributes attributes() {
    const bool has_faces = std::ranges::any_of(
        file_.elements, [](const ObjElement& element) { return element.primitive == Primitive::polygon; });
    const bool has_normals = keep_usable_normals(file_);
    const bool has_texture =
        std::ranges::any_of(materials_, [](const auto& material) { return material && material->texture; });
    const bool has_texcoords =
        std::ranges::any_of(file_.corners, [](const ObjCorner& corner) { return corner.texcoord >= 0; });
    const bool is_displayed = use_ == ModelUse::display;
    return {.normals = has_faces && (has_normals || is_displayed),
            .texcoords = has_texcoords || (has_texture && is_displayed),
            .colors = !file_.colors.empty()};
  }

  bool lacks_normals() const {
    return std::ranges::any_of(model_.mesh.indices, [&](std::uint32_t vertex) {
      return is_missing_normal(&model_.mesh.normals[3 * std::size_t{vertex}]);
    });
  }

  /// Groups elements by material, in the order of first use. Undefined materials count as none.
  std::vector<Group> grouped(Primitive primitive, const ReportProgress& progress) {
    constexpr std::size_t kReportInterval = 1 << 16;
    std::vector<Group> groups;
    std::map<int, std::size_t> group_of;
    std::size_t first = 0, elements = 0;
    for (const ObjElement& element : file_.elements) {
      if (progress && ++elements % kReportInterval == 0)
        progress(static_cast<double>(elements) / static_cast<double>(file_.elements.size()));
      const std::span<ObjCorner> corners = std::span(file_.corners).subspan(first, element.corner_count);
      first += element.corner_count;
      if (element.primitive != primitive) continue;
      const bool is_defined =
          element.material >= 0 && materials_[static_cast<std::size_t>(element.material)].has_value();
      const int material = is_defined ? element.material : -1;
      const auto [group, is_new] = group_of.try_emplace(material, groups.size());
      if (is_new) groups.emplace_back().material = material;
      add_element(element, corners, groups[group->second]);
    }
    return groups;
  }

  void add_element(const ObjElement& element, std::span<ObjCorner> corners, Group& group) {
    for (const ObjCorner& corner : corners) {
      group.has_color |= !file_.has_color.empty() && file_.has_color[corner.position];
      group.lacks_texcoords |= corner.texcoord < 0;
    }
    const ObjVertexLook look = look_of(group.material);
    const auto add = [&](std::size_t i) { group.indices.push_back(vertices_.index(corners[i], look)); };
    if (element.primitive == Primitive::polygon) {
      if (file_.has_smoothing_groups && element.smoothing_group == 0) make_flat(corners);
      if (corners.size() == 3) add(0), add(1), add(2);
      else
        for (const auto& triangle : split_polygon(positions_of(corners)))
          for (const std::uint32_t i : triangle) add(i);
      if (file_.has_smoothing_groups)
        group.smoothing_groups.resize(group.indices.size() / 3, element.smoothing_group);
    } else if (element.primitive == Primitive::line_strip) {
      for (std::size_t i = 1; i < corners.size(); ++i) add(i - 1), add(i);
    } else {
      for (std::size_t i = 0; i < corners.size(); ++i) add(i);
    }
  }

  /// Gives the corners that lack a normal that of their face.
  void make_flat(std::span<ObjCorner> corners) {
    const auto lacks_normal = [](const ObjCorner& corner) { return corner.normal < 0; };
    if (!attributes_.normals || std::ranges::none_of(corners, lacks_normal)) return;
    const std::array<double, 3> normal = polygon_normal(positions_of(corners));
    const double length = std::sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
    if (!(length > 0) || !std::isfinite(length)) return;
    const auto index = static_cast<std::int32_t>(file_.normals.size() / 3);
    for (const double x : normal) file_.normals.push_back(static_cast<float>(x / length));
    for (ObjCorner& corner : corners)
      if (lacks_normal(corner)) corner.normal = index;
  }

  /// Valid until the next call.
  std::span<const std::array<float, 3>> positions_of(std::span<const ObjCorner> corners) {
    corner_positions_.clear();
    for (const ObjCorner& corner : corners) {
      const float* const p = &positions_[3 * std::size_t{corner.position}];
      corner_positions_.push_back({p[0], p[1], p[2]});
    }
    return corner_positions_;
  }

  ObjVertexLook look_of(int number) const {
    if (number < 0 || use_ == ModelUse::mesh) return {};
    const ObjMaterial& material = *materials_[static_cast<std::size_t>(number)];
    const Color& diffuse = material.material.diffuse;
    const bool changes_color =
        attributes_.colors && (diffuse.r != 1 || diffuse.g != 1 || diffuse.b != 1 || diffuse.a != 1);
    const bool changes_texcoords = material.texcoord_scale != std::array<float, 2>{1, 1} ||
                                   material.texcoord_offset != std::array<float, 2>{0, 0};
    if (!changes_color && !changes_texcoords) return {};
    return {.number = static_cast<std::uint32_t>(number) + 1,
            .color_factor = {diffuse.r, diffuse.g, diffuse.b, diffuse.a},
            .texcoord_scale = material.texcoord_scale,
            .texcoord_offset = material.texcoord_offset};
  }

  void add_part(Group&& group, Primitive primitive) {
    ModelPart part{.material_name = {},
                   .material = {},
                   .primitive = primitive,
                   .first_index = model_.mesh.indices.size(),
                   .index_count = group.indices.size(),
                   .uses_colors = group.has_color,
                   .is_unlit = primitive != Primitive::triangles};
    if (group.material >= 0) {
      const ObjMaterial& material = *materials_[static_cast<std::size_t>(group.material)];
      part.material_name = material.name;
      part.material = material.material;
      part.texture = material.texture;
      part.alpha = material.alpha;
    }
    model_.mesh.indices.insert(model_.mesh.indices.end(), group.indices.begin(), group.indices.end());
    model_.parts.push_back(std::move(part));
    lacks_texcoords_.push_back(group.lacks_texcoords);
  }

  ObjFile& file_;
  const Materials& materials_;
  ModelUse use_;
  ReportProgress progress_;
  Model& model_;
  std::vector<float> positions_;
  ObjAttributes attributes_;
  ObjVertices vertices_;
  std::vector<std::array<float, 3>> corner_positions_;
  std::vector<bool> lacks_texcoords_;  // one per part
};

}  // namespace

Model import_obj(const std::string& path, ModelUse use, const ReportProgress& progress) {
  const bool is_displayed = use == ModelUse::display;
  ObjFile file = parse_obj(read_text_file(path), path, part_of(progress, 0, 0.5));
  Model model;
  const Materials materials = obj_materials(file, path, model);
  if (is_displayed) {
    add_points_of_lone_vertices(file);
    model.origin = origin_of(file);
  }
  Builder builder(file, materials, use, part_of(progress, 0.5, 1), model);
  builder.add_triangles();
  if (is_displayed) {
    builder.add_lines();
    builder.add_points();
  }
  if (model.parts.empty()) throw Error(path + (is_displayed ? ": holds no vertex" : ": holds no triangle"));
  builder.warn_of_texcoords(path);
  return model;
}

}  // namespace tessera::program
