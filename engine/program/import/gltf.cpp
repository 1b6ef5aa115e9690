#include "engine/program/import/gltf.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "engine/program/import/gltf_mesh.h"
#include "engine/program/import/gltf_pose.h"
#include "engine/program/import/gltf_view.h"
#include "engine/program/import/model_normals.h"
#include "engine/program/import/model_origin.h"
#include "engine/program/scene/text_file.h"

namespace tessera::program {
namespace {

/// Structures of the file. Buffers and images are left out: gltf_file.h reads them. So are the accessors of
/// compressed indices, which have no buffer view.
tinygltf::Model parse(const GltfFile& file) {
  nlohmann::json json = file.json;
  json.erase("images");
  if (json.contains("buffers"))
    for (nlohmann::json& buffer : json["buffers"])
      buffer = {{"byteLength", 1}, {"uri", "data:application/octet-stream;base64,AA=="}};
  if (json.contains("meshes"))
    for (nlohmann::json& mesh : json["meshes"])
      if (mesh.contains("primitives"))
        for (nlohmann::json& primitive : mesh["primitives"])
          if (primitive.contains("/extensions/KHR_draco_mesh_compression"_json_pointer))
            primitive.erase("indices");
  const std::string text = json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  tinygltf::TinyGLTF loader;
  tinygltf::Model gltf;
  std::string error, warning;
  if (!loader.LoadASCIIFromString(&gltf, &error, &warning, text.data(), static_cast<unsigned>(text.size()),
                                  "")) {
    std::ranges::replace(error, '\n', ' ');
    throw Error("is not valid glTF: " + error);
  }
  return gltf;
}

/// Puts all primitives in world space into one mesh, with one part per material and kind of primitive.
class GltfConverter {
 public:
  explicit GltfConverter(const GltfFile& file)
      : file_(file),
        gltf_(parse(file)),
        world_(gltf_world(gltf_)),
        images_(gltf_images(file)),
        materials_(gltf_materials(gltf_, images_.size())) {}

  Model converted(const ReportProgress& progress) {
    double visited = 0;
    for (const std::size_t node : world_.nodes) {
      if (gltf_.nodes[node].mesh >= 0) add_mesh(gltf_.nodes[node], world_.matrices[node]);
      if (progress) progress(++visited / static_cast<double>(world_.nodes.size()));
    }
    Model model{.images = std::move(images_), .warnings = file_.warnings};
    for (const auto& [key, indices] : indices_)
      if (!indices.empty()) add_part(key.first, materials_[key.second], indices, model);
    if (model.parts.empty()) throw Error("holds no triangle, line or point");
    move_vertices(model);
    return model;
  }

 private:
  void add_mesh(const tinygltf::Node& node, const GltfMatrix& world) {
    if (static_cast<std::size_t>(node.mesh) >= gltf_.meshes.size())
      throw Error("a node refers to mesh " + std::to_string(node.mesh) + ", there are " +
                  std::to_string(gltf_.meshes.size()));
    const tinygltf::Mesh& mesh = gltf_.meshes[static_cast<std::size_t>(node.mesh)];
    std::vector<GltfMatrix> joints;
    if (node.skin >= 0) joints = joint_matrices(file_, gltf_, world_, node.skin);
    for (const tinygltf::Primitive& primitive : mesh.primitives) {
      const std::size_t material = material_number(primitive.material);
      const GltfPrimitive from = read_primitive(
          file_, gltf_, primitive, node.weights.empty() ? mesh.weights : node.weights, materials_[material]);
      add_primitive(from, material, world, joints);
    }
  }

  /// The default material is the last one.
  std::size_t material_number(int number) const {
    if (number < 0) return materials_.size() - 1;
    if (static_cast<std::size_t>(number) + 1 >= materials_.size())
      throw Error("a primitive refers to material " + std::to_string(number) + ", there are " +
                  std::to_string(materials_.size() - 1));
    return static_cast<std::size_t>(number);
  }

  void add_primitive(const GltfPrimitive& from, std::size_t material, const GltfMatrix& world,
                     const std::vector<GltfMatrix>& joints) {
    const auto first = static_cast<std::uint32_t>(positions_.size());
    const bool is_skinned = !joints.empty() && from.joints.count() > 0;
    bool is_mirrored = determinant(world) < 0;
    for (std::size_t i = 0; i < from.positions.size(); ++i) {
      const GltfMatrix m = is_skinned ? blended(joints, from, i) : world;
      if (is_skinned && i == 0) is_mirrored = determinant(m) < 0;
      positions_.push_back(transformed_point(m, from.positions[i].data()));
      normals_.push_back(from.normals.empty() ? std::array<double, 3>{}
                                              : transformed_normal(m, from.normals[i].data()));
      add_color(from, materials_[material], i);
      add_texcoords(from, materials_[material], i);
    }
    std::vector<std::uint32_t>& indices = indices_[{order_of(from.primitive), material}];
    for (const std::uint32_t index : from.indices) indices.push_back(first + index);
    if (!is_mirrored || from.primitive != Primitive::triangles) return;
    for (std::size_t i = indices.size() - from.indices.size(); i + 2 < indices.size(); i += 3)
      std::swap(indices[i + 1], indices[i + 2]);
  }

  /// The weighted sum of the matrices of a vertex's joints.
  static GltfMatrix blended(const std::vector<GltfMatrix>& joints, const GltfPrimitive& from,
                            std::size_t vertex) {
    GltfMatrix sum{};
    double total = 0;
    for (std::size_t k = 0; k < std::min(from.joints.components, from.weights.components); ++k) {
      const double weight = from.weights.element(vertex)[k];
      if (weight == 0) continue;
      const double joint = from.joints.element(vertex)[k];
      if (!(joint >= 0 && joint < static_cast<double>(joints.size())))
        throw Error("a vertex refers to joint " + std::to_string(static_cast<int>(joint)) +
                    ", the skin has " + std::to_string(joints.size()));
      for (std::size_t i = 0; i < 16; ++i) sum[i] += weight * joints[static_cast<std::size_t>(joint)][i];
      total += weight;
    }
    for (double& x : sum) x = total > 0 ? x / total : x;
    return sum;
  }

  /// Linear products become display-referred.
  void add_color(const GltfPrimitive& from, const GltfMaterial& material, std::size_t vertex) {
    const std::array<double, 4> factor =
        from.colors.empty() ? std::array<double, 4>{1, 1, 1, 1} : from.colors[vertex];
    has_colors_ = has_colors_ || !from.colors.empty();
    for (std::size_t k = 0; k < 3; ++k) colors_.push_back(display_referred(factor[k] * material.base[k]));
    colors_.push_back(static_cast<float>(std::clamp(factor[3] * material.base[3], 0.0, 1.0)));
  }

  /// t runs upwards in the engine.
  void add_texcoords(const GltfPrimitive& from, const GltfMaterial& material, std::size_t vertex) {
    double s = 0, t = 0;
    if (material.texture && !from.texcoords.empty()) {
      const auto& [u, v] = from.texcoords[vertex];
      const GltfTexture& to = *material.texture;
      s = to.x[0] * u + to.x[1] * v + to.x[2];
      t = to.y[0] * u + to.y[1] * v + to.y[2];
    }
    texcoords_.push_back(static_cast<float>(s));
    texcoords_.push_back(static_cast<float>(1 - t));
  }

  static std::size_t order_of(Primitive primitive) {
    if (primitive == Primitive::triangles) return 0;
    return primitive == Primitive::lines ? 1 : 2;
  }

  void add_part(std::size_t order, const GltfMaterial& material, const std::vector<std::uint32_t>& indices,
                Model& model) {
    constexpr Primitive kPrimitives[] = {Primitive::triangles, Primitive::lines, Primitive::points};
    ModelPart part = material.part;
    part.primitive = kPrimitives[order];
    part.first_index = model.mesh.indices.size();
    part.index_count = indices.size();
    part.uses_colors = has_colors_;
    if (material.texture) {
      part.texture = model.textures.size();
      model.textures.push_back(material.texture->texture);
    }
    model.mesh.indices.insert(model.mesh.indices.end(), indices.begin(), indices.end());
    model.parts.push_back(std::move(part));
  }

  void move_vertices(Model& model) {
    model.origin = origin_for(positions_);
    append_relative(positions_, model.origin, model.mesh.positions);
    for (const std::array<double, 3>& n : normals_) {
      const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
      for (const double x : n)
        model.mesh.normals.push_back(length > 0 ? static_cast<float>(x / length) : 0.0f);
    }
    if (has_colors_) model.mesh.colors = std::move(colors_);
    if (!model.textures.empty()) model.mesh.texcoords = std::move(texcoords_);
  }

  const GltfFile& file_;
  tinygltf::Model gltf_;
  GltfWorld world_;
  std::vector<ModelImage> images_;
  std::vector<GltfMaterial> materials_;
  bool has_colors_ = false;
  std::vector<std::array<double, 3>> positions_, normals_;  ///< in world space
  std::vector<float> colors_, texcoords_;
  /// Vertex indices by kind of primitive (0: triangles, 1: lines, 2: points) and material.
  std::map<std::pair<std::size_t, std::size_t>, std::vector<std::uint32_t>> indices_;
};

}  // namespace

Model import_gltf(const std::string& path, const ReportProgress& progress) {
  const GltfFile file = read_gltf_file(path);
  try {
    Model model = GltfConverter(file).converted(part_of(progress, 0.2, 0.7));
    constexpr double kFlat = 0;
    add_creased_normals(model, kFlat, part_of(progress, 0.7, 1));
    Model view;
    add_gltf_view_of_bytes(read_text_file(path), view);
    model.cameras = std::move(view.cameras);
    model.lights = std::move(view.lights);
    move_view_to_origin(model);
    model.warnings.insert(model.warnings.end(), view.warnings.begin(), view.warnings.end());
    for (std::string& warning : model.warnings) warning = path + ": " + warning;
    return model;
  } catch (const nlohmann::json::exception& error) {
    throw Error(path + ": is not valid glTF: " + error.what());
  } catch (const Error& error) {
    throw Error(error.code(), path + ": " + error.what());
  }
}

}  // namespace tessera::program
