// Malformed assimp scenes: missing arrays, non-finite numbers, and indices out of range.
#pragma once

#include <cstddef>
#include <string_view>

#include <assimp/material.h>
#include <assimp/scene.h>

#include "tests/fuzz/fuzz_input.h"

namespace tessera::fuzz {

class AssimpSceneCase {
 public:
  explicit AssimpSceneCase(FuzzInput& from) : from_(from) {
    fill(scene_.mMaterials, scene_.mNumMaterials, from_.below(4), [&](aiMaterial& m) { make(m); });
    fill(scene_.mMeshes, scene_.mNumMeshes, from_.below(4), [&](aiMesh& m) { make(m); });
    fill(scene_.mCameras, scene_.mNumCameras, from_.below(3), [&](aiCamera& c) { make(c); });
    fill(scene_.mLights, scene_.mNumLights, from_.below(4), [&](aiLight& l) { make(l); });
    if (from_.rarely()) return;
    scene_.mRootNode = new aiNode;
    make(*scene_.mRootNode, 0);
  }

  const aiScene& scene() const { return scene_; }

 private:
  template <class T, class Make>
  static void fill(T**& list, unsigned& count, int wanted, const Make& make_one) {
    count = static_cast<unsigned>(wanted);
    if (wanted == 0) return;
    list = new T*[count];
    for (unsigned i = 0; i < count; ++i) make_one(*(list[i] = new T));
  }
  template <class T, class Next>
  static T* list_of(unsigned count, const Next& next) {
    T* const list = new T[count];
    for (unsigned i = 0; i < count; ++i) list[i] = next();
    return list;
  }

  ai_real real() { return from_.real32(); }
  aiVector3D vector() {
    const ai_real x = real(), y = real();
    return {x, y, real()};
  }
  aiColor3D rgb() {
    const ai_real r = real(), g = real();
    return {r, g, real()};
  }
  aiColor4D rgba() {
    const aiColor3D c = rgb();
    return {c.r, c.g, c.b, real()};
  }
  aiString name() {
    constexpr const char* kNames[] = {"", "a", "b",
                                      "c"};  // few, so that the names of nodes, cameras and lights coincide
    return aiString(std::string(kNames[from_.below(4)]));
  }

  void make(aiMesh& mesh) {
    mesh.mPrimitiveTypes = from_.rarely() ? from_.byte() : unsigned{aiPrimitiveType_TRIANGLE};
    mesh.mMaterialIndex = from_.byte() % 5u;
    const unsigned vertices = mesh.mNumVertices = from_.byte() % 17u;
    if (!from_.rarely()) mesh.mVertices = list_of<aiVector3D>(vertices, [&] { return vector(); });
    if (from_.coin()) mesh.mNormals = list_of<aiVector3D>(vertices, [&] { return vector(); });
    if (from_.coin()) mesh.mColors[0] = list_of<aiColor4D>(vertices, [&] { return rgba(); });
    if (from_.coin()) mesh.mTextureCoords[0] = list_of<aiVector3D>(vertices, [&] { return vector(); });
    mesh.mNumFaces = from_.byte() % 17u;
    if (from_.rarely()) return;
    mesh.mFaces = new aiFace[mesh.mNumFaces];
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      aiFace& face = mesh.mFaces[f];
      face.mNumIndices = from_.rarely() ? from_.byte() % 5u : 3;
      if (face.mNumIndices > 0)
        face.mIndices = list_of<unsigned>(face.mNumIndices, [&] {
          return from_.rarely() ? from_.word() : from_.byte() % (vertices + (vertices == 0));
        });
    }
  }

  void add(aiMaterial& material, const char* key, unsigned type, unsigned index, int max_numbers) {
    ai_real numbers[4];
    const int count = from_.rarely() ? 1 + from_.below(4) : max_numbers;
    for (int i = 0; i < count; ++i) numbers[i] = real();
    material.AddBinaryProperty(numbers, static_cast<unsigned>(count) * sizeof(ai_real), key, type, index,
                               from_.rarely() ? aiPTI_Integer : aiPTI_Float);
  }
  void make(aiMaterial& material) {
    const unsigned has = from_.word();
    const auto colors = [&](int bit, const char* key, unsigned type, unsigned index) {
      if ((has >> bit & 1) != 0) add(material, key, type, index, 4);
    };
    const auto number = [&](int bit, const char* key, unsigned type, unsigned index) {
      if ((has >> bit & 1) != 0) add(material, key, type, index, 1);
    };
    colors(0, AI_MATKEY_COLOR_DIFFUSE), colors(1, AI_MATKEY_COLOR_AMBIENT),
        colors(2, AI_MATKEY_COLOR_SPECULAR), colors(3, AI_MATKEY_COLOR_EMISSIVE);
    number(4, AI_MATKEY_SHININESS), number(5, AI_MATKEY_OPACITY), number(6, AI_MATKEY_METALLIC_FACTOR),
        number(7, AI_MATKEY_ROUGHNESS_FACTOR);
    colors(8, AI_MATKEY_BASE_COLOR);
    number(9, AI_MATKEY_GLOSSINESS_FACTOR);
    const int model = static_cast<int>(has >> 10 & 15);
    if (model > 0) material.AddProperty(&model, 1, AI_MATKEY_SHADING_MODEL);
    const aiString text = name();
    if ((has >> 14 & 1) != 0) material.AddProperty(&text, AI_MATKEY_NAME);
    if ((has >> 15 & 1) != 0) material.AddProperty(&text, AI_MATKEY_TEXTURE_DIFFUSE(0));
    if ((has >> 16 & 1) != 0) material.AddProperty(&text, AI_MATKEY_TEXTURE(aiTextureType_EMISSIVE, 0));
  }

  void make(aiCamera& camera) {
    camera.mName = name();
    camera.mPosition = vector();
    camera.mUp = vector();
    camera.mLookAt = vector();
    camera.mHorizontalFOV = real();
    camera.mClipPlaneNear = real();
    camera.mClipPlaneFar = real();
    camera.mAspect = real();
    if (from_.coin()) camera.mOrthographicWidth = real();
  }
  void make(aiLight& light) {
    light.mName = name();
    light.mType = from_.one_of<aiLightSourceType>(6);
    light.mPosition = vector();
    light.mDirection = vector();
    light.mAttenuationConstant = real();
    light.mAttenuationLinear = real();
    light.mAttenuationQuadratic = real();
    light.mColorDiffuse = rgb();
    light.mColorAmbient = rgb();
    light.mAngleInnerCone = real();
    light.mAngleOuterCone = real();
  }

  void make(aiNode& node, int depth) {
    node.mName = name();
    if (from_.coin())
      for (unsigned k = 0; k < 16; ++k) node.mTransformation[k / 4][k % 4] = real();
    node.mNumMeshes = from_.byte() % 4u;
    node.mMeshes = list_of<unsigned>(node.mNumMeshes, [&] {
      return from_.rarely() ? from_.word() : from_.byte() % (scene_.mNumMeshes + (scene_.mNumMeshes == 0));
    });
    constexpr int kMaxNodeDepth = 600;  // more than the importer follows
    const int children = depth < kMaxNodeDepth && !from_.empty() ? from_.below(3) : 0;
    fill(node.mChildren, node.mNumChildren, children, [&](aiNode& child) { make(child, depth + 1); });
  }

  FuzzInput& from_;
  aiScene scene_;
};

}  // namespace tessera::fuzz
