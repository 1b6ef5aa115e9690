#include "engine/program/import/threemf.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "engine/program/import/index_table.h"
#include "engine/program/import/model_origin.h"
#include "engine/program/import/threemf_resources.h"
#include "engine/program/import/threemf_xml.h"

namespace tessera::program {
namespace {

using namespace threemf;

constexpr int kMaxObjects = 1'000'000;  // components may refer to components, each twice as many as the last

/// A model part of the package: its document, and the resources that point into it.
struct ModelDocument {
  std::string name;
  pugi::xml_document document;
  pugi::xml_node model;
  Resources resources;
};

/// The property of a triangle's corners.
struct Selection {
  const Properties* group = nullptr;     ///< null: none
  std::array<std::size_t, 3> corners{};  ///< indices into the group
};

class Builder {
 public:
  Builder(const ReadPart& read, const ReportProgress& progress) : read_(read), progress_(progress) {}

  Model built() {
    const ModelDocument& root = document(model_part_name(read_));
    report(0.4);
    const pugi::xml_node build = child(root.model, "build");
    const auto items = static_cast<double>(std::distance(build.begin(), build.end()));
    double added = 0;
    for_each_child(build, "item", [&](const pugi::xml_node& item) {
      add_reference(item, root, {}, 0);
      report(0.4 + 0.6 * ++added / items);
    });
    for (Part& part : parts_) add_part(part);
    if (model_.parts.empty()) throw Error(std::string(kHoldsNothing));
    model_.origin = origin_for(positions_);
    append_relative(positions_, model_.origin, model_.mesh.positions);
    model_.mesh.normals.resize(model_.mesh.positions.size());
    if (!has_colors_) model_.mesh.colors.clear();
    if (!has_texcoords_) model_.mesh.texcoords.clear();
    if (has_undefined_properties_)
      model_.warnings.push_back("some triangles have properties that are not defined; they are drawn grey");
    return std::move(model_);
  }

 private:
  /// Triangles with the same material.
  struct Part {
    ModelPart part;
    std::vector<std::uint32_t> indices;
  };
  /// A vertex of a mesh with a property, in a part.
  struct VertexKey {
    std::size_t part, vertex, property;
    bool operator==(const VertexKey&) const = default;
  };

  void report(double done) const {
    if (progress_) progress_(done);
  }

  const ModelDocument& document(const std::string& name) {
    std::unique_ptr<ModelDocument>& known = documents_[name];
    if (known) return *known;
    const std::optional<std::string> text = read_(name);
    if (!text) throw Error("the archive lacks the model part \"" + name + "\"");
    auto loaded = std::make_unique<ModelDocument>();
    loaded->name = name;
    const pugi::xml_parse_result result =
        loaded->document.load_buffer(text->data(), text->size(), pugi::parse_minimal | pugi::parse_escapes);
    if (!result)
      throw Error("\"" + name + "\" is not XML: " + result.description() + " at byte " +
                  std::to_string(result.offset));
    loaded->model = child(loaded->document, "model");
    if (!loaded->model) throw Error("\"" + name + "\" has no element <model>");
    loaded->resources = read_resources(loaded->model);
    for (std::string& warning : unread_extensions(loaded->model))
      model_.warnings.push_back(std::move(warning));
    known = std::move(loaded);
    return *known;
  }

  /// Adds the object that an item of the build or a component refers to.
  void add_reference(const pugi::xml_node& element, const ModelDocument& in, const Affine& parent,
                     int depth) {
    if (depth > kMaxNodeDepth)
      throw Error("its components are nested deeper than " + std::to_string(kMaxNodeDepth) + " levels");
    if (++object_count_ > kMaxObjects)
      throw Error("it has more than " + std::to_string(kMaxObjects) + " objects");
    const std::optional<std::string> path = find_attribute(element, "path");
    const ModelDocument& from = path ? document(*path) : in;
    const std::string id = required_attribute(element, "objectid");
    const auto object = from.resources.objects.find(id);
    if (object == from.resources.objects.end())
      throw Error("\"" + from.name + "\" has no object with the id \"" + id.substr(0, 40) + "\"");
    const Affine world = concatenated(transform(element), parent);
    if (const pugi::xml_node mesh = child(object->second, "mesh"))
      add_mesh(mesh, object->second, from, world);
    for_each_child(child(object->second, "components"), "component", [&](const pugi::xml_node& component) {
      add_reference(component, from, world, depth + 1);
    });
  }

  void add_mesh(const pugi::xml_node& mesh, const pugi::xml_node& object, const ModelDocument& from,
                const Affine& world) {
    mesh_positions_.clear();
    for_each_child(child(mesh, "vertices"), "vertex", [&](const pugi::xml_node& vertex) {
      mesh_positions_.push_back(world(
          {number_attribute(vertex, "x"), number_attribute(vertex, "y"), number_attribute(vertex, "z")}));
    });
    mesh_keys_.clear();
    mesh_vertices_ = {};
    const bool mirrors = world.mirrors();
    for_each_child(child(mesh, "triangles"), "triangle", [&](const pugi::xml_node& triangle) {
      add_triangle(triangle, mirrors, selection(triangle, object, from.resources), from.resources);
    });
  }

  /// The triangle's own properties, or else the object's.
  Selection selection(const pugi::xml_node& triangle, const pugi::xml_node& object, const Resources& in) {
    const bool has_own = find_attribute(triangle, "p1").has_value();
    std::optional<std::string> id = has_own ? find_attribute(triangle, "pid") : std::nullopt;
    if (!id) id = find_attribute(object, "pid");
    if (!id) return {};
    Selection selected;
    if (has_own) {
      selected.corners.fill(index_attribute(triangle, "p1"));
      if (find_attribute(triangle, "p2")) selected.corners[1] = index_attribute(triangle, "p2");
      if (find_attribute(triangle, "p3")) selected.corners[2] = index_attribute(triangle, "p3");
    } else if (find_attribute(object, "pindex")) {
      selected.corners.fill(index_attribute(object, "pindex"));
    }
    const auto group = in.properties.find(*id);
    bool is_defined = group != in.properties.end();
    for (const std::size_t corner : selected.corners)
      is_defined = is_defined && corner < group->second.size();
    has_undefined_properties_ = has_undefined_properties_ || !is_defined;
    if (is_defined) selected.group = &group->second;
    return selected;
  }

  void add_triangle(const pugi::xml_node& triangle, bool mirrors, const Selection& selected,
                    const Resources& in) {
    const std::size_t part = part_of(selected, in);
    constexpr const char* kNames[] = {"v1", "v2", "v3"};
    std::array<std::uint32_t, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t at = index_attribute(triangle, kNames[k]);
      if (at >= mesh_positions_.size())
        throw Error("a triangle refers to vertex " + std::to_string(at) + ", there are " +
                    std::to_string(mesh_positions_.size()));
      corners[k] = vertex(part, at, selected, k);
    }
    if (mirrors) std::swap(corners[1], corners[2]);
    parts_[part].indices.insert(parts_[part].indices.end(), corners.begin(), corners.end());
  }

  std::uint32_t vertex(std::size_t part, std::size_t at, const Selection& selected, std::size_t corner) {
    const bool is_per_corner =
        selected.group != nullptr && selected.group->kind != Properties::Kind::materials;
    const VertexKey key{part, at, is_per_corner ? selected.corners[corner] : 0};
    const std::size_t first = positions_.size() - mesh_keys_.size();
    const auto next = static_cast<std::uint32_t>(positions_.size());
    const std::uint64_t hash = mixed(mixed(mixed(0, key.part), key.vertex), key.property);
    const std::uint32_t known =
        mesh_vertices_.find_or_add(static_cast<std::uint32_t>(hash >> 32), next,
                                   [&](std::uint32_t i) { return mesh_keys_[i - first] == key; });
    if (known != next) return known;
    mesh_keys_.push_back(key);
    positions_.push_back(mesh_positions_[at]);
    Color color{1, 1, 1, 1};
    std::array<float, 2> texcoord{};
    if (is_per_corner && selected.group->kind == Properties::Kind::colors)
      color = selected.group->colors[key.property];
    if (is_per_corner && selected.group->kind == Properties::Kind::texcoords)
      texcoord = selected.group->texcoords[key.property];
    model_.mesh.colors.insert(model_.mesh.colors.end(), {color.r, color.g, color.b, color.a});
    model_.mesh.texcoords.insert(model_.mesh.texcoords.end(), texcoord.begin(), texcoord.end());
    return next;
  }

  /// The index of the part that triangles with these properties belong to.
  std::size_t part_of(const Selection& selected, const Resources& in) {
    const Properties* const group = selected.group;
    const bool is_material = group != nullptr && group->kind == Properties::Kind::materials;
    const std::pair key{group, is_material ? selected.corners[0] : 0};
    const auto [known, is_new] = part_numbers_.try_emplace(key, parts_.size());
    if (is_new) parts_.push_back({.part = described(group, key.second, in), .indices = {}});
    return known->second;
  }

  ModelPart described(const Properties* group, std::size_t material, const Resources& in) {
    ModelPart part;
    if (group == nullptr) return part;
    part.alpha = ModelAlpha::blend;  // drawn as opaque if no alpha is below 1
    part.material.ambient = part.material.diffuse = {1, 1, 1, 1};
    switch (group->kind) {
      case Properties::Kind::materials:
        part.material_name = material < group->names.size() ? group->names[material] : "";
        part.material.diffuse = group->colors[material];
        part.material.ambient = {part.material.diffuse.r, part.material.diffuse.g, part.material.diffuse.b,
                                 1};
        break;
      case Properties::Kind::colors: part.uses_colors = has_colors_ = true; break;
      case Properties::Kind::texcoords:
        part.texture = texture(group->texture, in);
        has_texcoords_ = has_texcoords_ || part.texture.has_value();
        break;
    }
    return part;
  }

  std::optional<std::size_t> texture(const std::string& id, const Resources& in) {
    const auto found = in.textures.find(id);
    if (found == in.textures.end()) {
      model_.warnings.push_back("there is no texture with the id \"" + id.substr(0, 40) + "\"");
      return std::nullopt;
    }
    const std::optional<std::size_t> image = image_of(found->second.part);
    if (!image) return std::nullopt;
    model_.textures.push_back({*image, found->second.sampler});
    return model_.textures.size() - 1;
  }

  std::optional<std::size_t> image_of(const std::string& name) {
    const auto [known, is_new] = image_numbers_.try_emplace(name);
    if (!is_new) return known->second;
    std::optional<std::string> bytes = read_(name);
    if (!bytes || bytes->empty()) {
      model_.warnings.push_back("the archive lacks the image \"" + name.substr(0, 80) + "\"");
      return std::nullopt;
    }
    known->second = model_.images.size();
    ModelImage& image = model_.images.emplace_back();
    image.name = name;
    image.encoded = std::move(*bytes);
    return known->second;
  }

  void add_part(Part& part) {
    if (part.indices.empty()) return;
    part.part.first_index = model_.mesh.indices.size();
    part.part.index_count = part.indices.size();
    model_.mesh.indices.insert(model_.mesh.indices.end(), part.indices.begin(), part.indices.end());
    model_.parts.push_back(std::move(part.part));
  }

  const ReadPart& read_;
  const ReportProgress& progress_;
  std::map<std::string, std::unique_ptr<ModelDocument>> documents_;
  int object_count_ = 0;
  // The mesh that is being added: its vertices in world space, and which of them have become vertices of the
  // model.
  std::vector<std::array<double, 3>> mesh_positions_;
  std::vector<VertexKey> mesh_keys_;
  IndexTable mesh_vertices_;
  // The model.
  std::vector<std::array<double, 3>> positions_;
  std::vector<Part> parts_;
  std::map<std::pair<const Properties*, std::size_t>, std::size_t> part_numbers_;
  std::map<std::string, std::optional<std::size_t>> image_numbers_;
  bool has_colors_ = false, has_texcoords_ = false, has_undefined_properties_ = false;
  Model model_;
};

std::string without_control_characters(std::string text) {
  std::ranges::replace_if(
      text, [](unsigned char c) { return c < ' ' || c == 0x7f; }, '?');
  return text;
}

}  // namespace

Model read_threemf_parts(const ReadPart& read, const ReportProgress& progress) {
  try {
    Model model = Builder(read, progress).built();
    for (std::string& warning : model.warnings) warning = without_control_characters(warning);
    return model;
  } catch (const Error& error) {  // quotes the file
    throw Error(error.code(), without_control_characters(error.what()));
  }
}

Model read_threemf(const std::string& path, const ReportProgress& progress) {
  const Package package(path);
  return read_threemf_parts([&](const std::string& name) { return package.read(name); }, progress);
}

}  // namespace tessera::program
