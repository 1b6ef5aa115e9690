#include "engine/program/import/assimp_model.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/program/import/assimp_material.h"
#include "engine/program/import/assimp_view.h"

namespace tessera::program {
namespace {

// Some of assimp's readers fill in 0 or -1 if a file has no vertex colours.
bool has_vertex_colors(const aiMesh& mesh) {
  bool any_positive = false;
  for (unsigned v = 0; v < mesh.mNumVertices && mesh.HasVertexColors(0); ++v) {
    const aiColor4D& c = mesh.mColors[0][v];
    if (!(c.r >= 0 && c.g >= 0 && c.b >= 0 && c.a >= 0)) return false;
    any_positive |= c.r > 0 || c.g > 0 || c.b > 0 || c.a > 0;
  }
  return any_positive;
}

/// Merges the meshes of all nodes of a scene, in world space, into one mesh.
class Converter {
 public:
  Converter(const aiScene& scene, bool is_collada)
      : scene_(scene),
        is_collada_(is_collada),
        camera_used_(scene.mNumCameras),
        light_used_(scene.mNumLights) {
    for (unsigned m = 0; m < scene_.mNumMeshes; ++m)
      mesh_has_colors_.push_back(has_vertex_colors(*scene_.mMeshes[m]));
    has_colors_ = std::find(mesh_has_colors_.begin(), mesh_has_colors_.end(), true) != mesh_has_colors_.end();
    for (unsigned m = 0; m < scene_.mNumMeshes; ++m) has_texcoords_ |= scene_.mMeshes[m]->HasTextureCoords(0);
    for (unsigned m = 0; m < scene_.mNumMaterials; ++m) {
      materials_.push_back(material_of(*scene_.mMaterials[m]));
      textures_.push_back(color_texture_of(*scene_.mMaterials[m]));
    }
    has_mapped_mesh_.resize(scene_.mNumMaterials);
    for (unsigned m = 0; m < scene_.mNumMeshes; ++m)
      if (const aiMesh& mesh = *scene_.mMeshes[m]; mesh.mMaterialIndex < scene_.mNumMaterials)
        has_mapped_mesh_[mesh.mMaterialIndex] =
            has_mapped_mesh_[mesh.mMaterialIndex] || mesh.HasTextureCoords(0);
  }

  Model converted() {
    if (scene_.mRootNode != nullptr) visit(*scene_.mRootNode, aiMatrix4x4(), 0);
    for (const auto& [key, indices] : by_material_)
      if (!indices.empty()) add_part(key, indices);
    if (model_.parts.empty()) throw Error(std::string(kHoldsNothing));
    return std::move(model_);
  }

 private:
  void visit(const aiNode& node, const aiMatrix4x4& parent, int depth) {
    if (depth > kMaxNodeDepth)
      throw Error("its nodes are nested deeper than " + std::to_string(kMaxNodeDepth) + " levels");
    const aiMatrix4x4 world = parent * node.mTransformation;
    for (unsigned m = 0; m < node.mNumMeshes; ++m) {
      if (node.mMeshes[m] >= scene_.mNumMeshes)
        throw Error("a node refers to mesh " + std::to_string(node.mMeshes[m]) + ", there are " +
                    std::to_string(scene_.mNumMeshes));
      add_mesh(node.mMeshes[m], world);
    }
    add_view(node, world);
    for (unsigned i = 0; i < node.mNumChildren; ++i) visit(*node.mChildren[i], world, depth + 1);
  }

  // assimp links cameras and lights to nodes by name. If nodes share a name, each takes the next unused one.
  void add_view(const aiNode& node, const aiMatrix4x4& world) {
    for (unsigned i = 0; i < scene_.mNumCameras; ++i)
      if (!camera_used_[i] && scene_.mCameras[i]->mName == node.mName) {
        camera_used_[i] = true;
        if (auto camera = camera_of(*scene_.mCameras[i], world, is_collada_))
          model_.cameras.push_back(*camera);
        break;
      }
    for (unsigned i = 0; i < scene_.mNumLights; ++i)
      if (!light_used_[i] && scene_.mLights[i]->mName == node.mName) {
        light_used_[i] = true;
        add_light(*scene_.mLights[i], world, is_collada_, model_);
        break;
      }
  }

  void add_mesh(unsigned number, const aiMatrix4x4& world) {
    const aiMesh& mesh = *scene_.mMeshes[number];
    if (!mesh.HasPositions() || !mesh.HasFaces()) return;
    const auto first = static_cast<std::uint32_t>(model_.mesh.vertex_count());
    aiMatrix3x3 normal_matrix(world);
    const bool mirrors = normal_matrix.Determinant() < 0;
    normal_matrix.Inverse().Transpose();
    for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
      const aiVector3D p = world * mesh.mVertices[v];
      model_.mesh.positions.insert(model_.mesh.positions.end(), {p.x, p.y, p.z});
      aiVector3D n = mesh.HasNormals() ? normal_matrix * mesh.mNormals[v] : aiVector3D();
      n.NormalizeSafe();
      model_.mesh.normals.insert(model_.mesh.normals.end(), {n.x, n.y, n.z});
      if (has_colors_) add_color(mesh, mesh_has_colors_[number], v);
      if (has_texcoords_) add_texcoords(mesh, v);
    }
    add_primitives(mesh, first, mirrors);
  }

  // Vertex colours are factors of the material's colour, so their product is stored per vertex.
  void add_color(const aiMesh& mesh, bool has_colors, unsigned vertex) {
    const Color base = mesh.mMaterialIndex < materials_.size() ? materials_[mesh.mMaterialIndex].diffuse
                                                               : Material{}.diffuse;
    const aiColor4D c = has_colors ? mesh.mColors[0][vertex] : aiColor4D(1, 1, 1, 1);
    model_.mesh.colors.insert(model_.mesh.colors.end(),
                              {c.r * base.r, c.g * base.g, c.b * base.b, c.a * base.a});
  }

  // assimp flips v where the format requires it, so t always grows upwards.
  void add_texcoords(const aiMesh& mesh, unsigned vertex) {
    const ColorTexture* texture = nullptr;
    if (mesh.mMaterialIndex < textures_.size() && textures_[mesh.mMaterialIndex])
      texture = &*textures_[mesh.mMaterialIndex];
    const unsigned channel =
        texture != nullptr && mesh.HasTextureCoords(texture->channel) ? texture->channel : 0;
    const aiVector3D at =
        mesh.HasTextureCoords(channel) ? mesh.mTextureCoords[channel][vertex] : aiVector3D();
    float s = at.x, t = at.y;
    if (texture != nullptr) {
      const aiUVTransform& to = texture->transform;
      const float x = (s - 0.5f) * to.mScaling.x, y = (t - 0.5f) * to.mScaling.y;
      const float sine = std::sin(to.mRotation), cosine = std::cos(to.mRotation);
      s = x * cosine - y * sine + 0.5f + to.mTranslation.x;
      t = x * sine + y * cosine + 0.5f + to.mTranslation.y;
    }
    model_.mesh.texcoords.insert(model_.mesh.texcoords.end(), {s, t});
  }

  void add_primitives(const aiMesh& mesh, std::uint32_t first, bool mirrors) {
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      const aiFace& face = mesh.mFaces[f];
      if (face.mNumIndices < 1 || face.mNumIndices > 3) continue;
      std::vector<std::uint32_t>& indices = by_material_[{3 - face.mNumIndices, mesh.mMaterialIndex}];
      for (unsigned k = 0; k < face.mNumIndices; ++k) {
        const unsigned corner = mirrors && face.mNumIndices == 3 && k > 0 ? 3 - k : k;
        if (face.mIndices[corner] >= mesh.mNumVertices)
          throw Error("a primitive refers to vertex " + std::to_string(face.mIndices[corner]) +
                      ", there are " + std::to_string(mesh.mNumVertices));
        indices.push_back(first + face.mIndices[corner]);
      }
    }
  }

  // An image of the scene, or the name of a file.
  std::size_t add_image(const std::string& name) {
    const auto [known, is_new] = image_numbers_.try_emplace(name, model_.images.size());
    if (!is_new) return known->second;
    ModelImage& image = model_.images.emplace_back();
    image.name = name;
    const aiTexture* embedded = scene_.GetEmbeddedTexture(name.c_str());
    if (embedded == nullptr) return known->second;
    if (embedded->mHeight == 0) {  // the bytes of an image file
      image.encoded.assign(reinterpret_cast<const char*>(embedded->pcData), embedded->mWidth);
      image.name += std::string(".") + embedded->achFormatHint;
      return known->second;
    }
    image.width = static_cast<int>(embedded->mWidth);
    image.height = static_cast<int>(embedded->mHeight);
    for (std::size_t i = 0; i < std::size_t{embedded->mWidth} * embedded->mHeight; ++i) {
      const aiTexel& texel = embedded->pcData[i];
      image.pixels.insert(image.pixels.end(), {texel.r, texel.g, texel.b, texel.a});
      image.has_alpha = image.has_alpha || texel.a < 255;
    }
    return known->second;
  }

  void set_texture(unsigned material, ModelPart& part) {
    if (!textures_[material] || !has_mapped_mesh_[material]) return;
    part.texture = model_.textures.size();
    model_.textures.push_back({add_image(textures_[material]->name), textures_[material]->sampler});
    Color& diffuse = part.material.diffuse;
    const bool is_black = diffuse.r <= 0 && diffuse.g <= 0 && diffuse.b <= 0;
    if (!is_black) return;
    diffuse = {1, 1, 1, diffuse.a};
    part.material.ambient = {1, 1, 1, 1};
  }

  void add_part(const std::pair<unsigned, unsigned>& key, const std::vector<std::uint32_t>& indices) {
    constexpr Primitive kPrimitives[] = {Primitive::triangles, Primitive::lines, Primitive::points};
    const unsigned material = key.second;
    ModelPart part{.material_name = {},
                   .material = {},
                   .primitive = kPrimitives[key.first],
                   .first_index = model_.mesh.indices.size(),
                   .index_count = indices.size(),
                   .uses_colors = has_colors_};
    if (material < scene_.mNumMaterials) {
      part.material_name = scene_.mMaterials[material]->GetName().C_Str();
      part.material = materials_[material];
      set_alpha(*scene_.mMaterials[material], part);
      set_texture(material, part);
    }
    model_.mesh.indices.insert(model_.mesh.indices.end(), indices.begin(), indices.end());
    model_.parts.push_back(std::move(part));
  }

  const aiScene& scene_;
  bool is_collada_;
  bool has_colors_ = false;
  bool has_texcoords_ = false;
  std::vector<bool> mesh_has_colors_;
  std::vector<bool> camera_used_;
  std::vector<bool> light_used_;
  std::vector<Material> materials_;
  std::vector<std::optional<ColorTexture>> textures_;  // by material
  std::vector<bool> has_mapped_mesh_;                  // materials used with texture coordinates
  std::map<std::string, std::size_t> image_numbers_;
  // Vertex indices by kind of primitive (0: triangles, 1: lines, 2: points) and material.
  std::map<std::pair<unsigned, unsigned>, std::vector<std::uint32_t>> by_material_;
  Model model_;
};

}  // namespace

Model model_of(const aiScene& scene, bool is_collada) { return Converter(scene, is_collada).converted(); }

}  // namespace tessera::program
