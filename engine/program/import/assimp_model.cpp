#include "engine/program/import/assimp_model.h"

#include <algorithm>
#include <map>
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
  /// @param with_view  also converts cameras and lights
  Converter(const aiScene& scene, bool with_view, bool is_collada)
      : scene_(scene),
        with_view_(with_view),
        is_collada_(is_collada),
        camera_used_(scene.mNumCameras),
        light_used_(scene.mNumLights) {
    for (unsigned m = 0; m < scene_.mNumMeshes; ++m)
      mesh_has_colors_.push_back(has_vertex_colors(*scene_.mMeshes[m]));
    has_colors_ = std::find(mesh_has_colors_.begin(), mesh_has_colors_.end(), true) != mesh_has_colors_.end();
    for (unsigned m = 0; m < scene_.mNumMeshes; ++m) has_texcoords_ |= scene_.mMeshes[m]->HasTextureCoords(0);
    for (unsigned m = 0; m < scene_.mNumMaterials; ++m)
      materials_.push_back(material_of(*scene_.mMaterials[m]));
  }

  Model converted() {
    if (scene_.mRootNode != nullptr) visit(*scene_.mRootNode, aiMatrix4x4(), 0);
    int textures = 0;
    int transparent = 0;
    for (const auto& [material, indices] : by_material_) {
      if (indices.empty()) continue;
      add_part(material, indices);
      if (material >= scene_.mNumMaterials) continue;
      textures += has_color_texture(*scene_.mMaterials[material]) ? 1 : 0;
      transparent += is_transparent(*scene_.mMaterials[material]) ? 1 : 0;
    }
    if (model_.parts.empty()) throw Error(std::string(kHoldsNoTriangle));
    if (textures > 0)
      model_.warnings.push_back("textures of models are not supported: " + std::to_string(textures) +
                                " materials with one keep their plain colours");
    if (transparent > 0)
      model_.warnings.push_back("transparency is not supported: " + std::to_string(transparent) +
                                " transparent materials are drawn opaque");
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
    if (with_view_) add_view(node, world);
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
    if ((mesh.mPrimitiveTypes & aiPrimitiveType_TRIANGLE) == 0 || !mesh.HasPositions() || !mesh.HasFaces())
      return;
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
    add_triangles(mesh, first, mirrors);
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
    const aiVector3D at = mesh.HasTextureCoords(0) ? mesh.mTextureCoords[0][vertex] : aiVector3D();
    model_.mesh.texcoords.insert(model_.mesh.texcoords.end(), {at.x, at.y});
  }

  void add_triangles(const aiMesh& mesh, std::uint32_t first, bool mirrors) {
    std::vector<std::uint32_t>& indices = by_material_[mesh.mMaterialIndex];
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      const aiFace& face = mesh.mFaces[f];
      if (face.mNumIndices != 3) continue;
      for (const unsigned k : {0u, mirrors ? 2u : 1u, mirrors ? 1u : 2u}) {
        if (face.mIndices[k] >= mesh.mNumVertices)
          throw Error("a triangle refers to vertex " + std::to_string(face.mIndices[k]) + ", there are " +
                      std::to_string(mesh.mNumVertices));
        indices.push_back(first + face.mIndices[k]);
      }
    }
  }

  void add_part(unsigned material, const std::vector<std::uint32_t>& indices) {
    ModelPart part{.material_name = {},
                   .material = {},
                   .first_index = model_.mesh.indices.size(),
                   .index_count = indices.size(),
                   .uses_colors = has_colors_};
    if (material < scene_.mNumMaterials) {
      part.material_name = scene_.mMaterials[material]->GetName().C_Str();
      part.material = materials_[material];
    }
    model_.mesh.indices.insert(model_.mesh.indices.end(), indices.begin(), indices.end());
    model_.parts.push_back(std::move(part));
  }

  const aiScene& scene_;
  bool with_view_;
  bool is_collada_;
  bool has_colors_ = false;
  bool has_texcoords_ = false;
  std::vector<bool> mesh_has_colors_;
  std::vector<bool> camera_used_;
  std::vector<bool> light_used_;
  std::vector<Material> materials_;
  std::map<unsigned, std::vector<std::uint32_t>> by_material_;  // triangles' vertex indices
  Model model_;
};

}  // namespace

Model model_of(const aiScene& scene, bool with_view, bool is_collada) {
  return Converter(scene, with_view, is_collada).converted();
}

}  // namespace tessera::program
