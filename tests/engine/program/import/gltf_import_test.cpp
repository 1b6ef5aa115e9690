// Imports glTF 2 files written from the specification: nodes, cameras, lights, materials.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include <unistd.h>

#include "engine/program/import/model.h"
#include "engine/program/scene/model_scene.h"

namespace tessera::gltf_import_test {
using namespace program;
namespace {

namespace fs = std::filesystem;

/// The curve of sRGB above its linear part [IEC 61966-2-1].
float srgb(double linear) { return static_cast<float>(1.055 * std::pow(linear, 1 / 2.4) - 0.055); }

class GltfImport : public testing::Test {
 protected:
  GltfImport() : folder_(fs::temp_directory_path() / ("tessera_gltf_" + std::to_string(::getpid()))) {
    fs::create_directories(folder_);
  }
  ~GltfImport() override { fs::remove_all(folder_); }

  // Imports one triangle (0 0 0), (1 0 0), (0 1 0) as mesh 0 with material 0; `members` is the rest of the
  // file.
  Model imported(const std::string& members, ModelUse use = ModelUse::mesh,
                 const std::string& attributes = R"("POSITION": 0)") const {
    const float numbers[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, /* colours */ 1, 1, 1, 0.5f, 0.5f, 0.5f, 0, 0, 1};
    std::ofstream(folder_ / "t.bin", std::ios::binary)
        .write(reinterpret_cast<const char*>(numbers), sizeof numbers);
    std::ofstream(folder_ / "t.gltf")
        << R"({"asset": {"version": "2.0"}, "scene": 0, "meshes": [{"primitives": [{"attributes": {)"
        << attributes << R"(}, "material": 0}]}],
      "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0],
    "max": [1, 1, 0]}, {"bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC3"}],
      "bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 36}],
    "buffers": [{"uri": "t.bin", "byteLength": 72}], )"
        << members << "}";
    return import_model((folder_ / "t.gltf").string(), use);
  }
  std::string error_of(const std::string& members) const {
    try {
      imported(members);
    } catch (const Error& error) {
      return error.what();
    }
    return "nothing was thrown";
  }
  Material material(const std::string& json, const std::string& more = "") const {
    return imported(R"("scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}], "materials": [)" + json + "]" +
                    more)
        .parts.at(0)
        .material;
  }

  fs::path folder_;
};

TEST_F(GltfImport, ReadsNodesCamerasAndLights) {
  const Model model = imported(
      R"("scenes": [{"nodes": [0, 1, 2, 3, 4, 5]}], "materials": [{"name": "m"}],
    "extensionsUsed": ["KHR_lights_punctual"],
    "extensions": {"KHR_lights_punctual": {"lights": [{"type": "directional", "intensity": 3,
    "color": [1, 0.5, 0]}, {"type": "point", "intensity": 10}, {"type": "spot", "intensity": 5,
    "spot": {"outerConeAngle": 0.5}}]}},
    "nodes": [{"mesh": 0, "translation": [5, 0, 0], "scale": [2, 2, 2]}, {"camera": 0,
    "translation": [0, 0, 7]},
              {"extensions": {"KHR_lights_punctual": {"light": 0}}},
    {"extensions": {"KHR_lights_punctual": {"light": 1}}, "translation": [1, 2, 3]},
              {"extensions": {"KHR_lights_punctual": {"light": 2}}}, {"camera": 1,
    "rotation": [0, 0.7071067811865476, 0, 0.7071067811865476]}],
    "cameras": [{"type": "perspective", "perspective": {"yfov": 0.8, "aspectRatio": 1.5, "znear": 0.5,
    "zfar": 50}},
                {"type": "orthographic", "orthographic": {"xmag": 4, "ymag": 3, "znear": 0.25,
    "zfar": 9}}])");
  ASSERT_EQ(model.mesh.vertex_count(), 3u);
  EXPECT_FLOAT_EQ(*std::max_element(model.mesh.positions.begin(), model.mesh.positions.end()), 7)
      << "5 + 2 * 1";
  ASSERT_EQ(model.cameras.size(), 2u);
  EXPECT_NEAR(model.cameras[0].half_height, std::tan(0.4), 1e-6);
  EXPECT_NEAR(model.cameras[0].view.m[11], -7, 1e-6);
  EXPECT_DOUBLE_EQ(model.cameras[0].near, 0.5);
  EXPECT_TRUE(model.cameras[1].is_orthographic);
  EXPECT_DOUBLE_EQ(model.cameras[1].half_height, 3);
  EXPECT_NEAR(model.cameras[1].view.m[8], 1, 1e-6) << "it looks along -x";
  ASSERT_EQ(model.lights.size(), 3u);
  EXPECT_FLOAT_EQ(model.lights[0].position[3], 0);
  EXPECT_FLOAT_EQ(model.lights[0].position[2], 1) << "it shines along -z";
  EXPECT_NEAR(model.lights[0].diffuse.g, srgb(1.5 / std::numbers::pi), 1e-5);
  EXPECT_FLOAT_EQ(model.lights[1].position[1], 2);
  EXPECT_FLOAT_EQ(model.lights[1].attenuation_constant, 0);
  EXPECT_FLOAT_EQ(model.lights[1].attenuation_linear, 1);
  EXPECT_FLOAT_EQ(model.lights[1].attenuation_quadratic, 0);
  EXPECT_NEAR(model.lights[2].spot_cutoff, 0.5 * 180 / std::numbers::pi, 1e-3);
  // Between the axis and 0.5, glTF's ramp ((cos t - cos 0.5) / (1 - cos 0.5))^2 is 1/2 at this angle.
  const double cosine = std::cos(0.5) + std::sqrt(0.5) * (1 - std::cos(0.5));
  EXPECT_NEAR(std::pow(cosine, model.lights[2].spot_exponent), 0.5, 1e-4);
  EXPECT_EQ(model_scene(model, "t", 64, 48).lights.size(), 3u);
}

TEST_F(GltfImport, RefusesReferencesToMissingNodes) {
  EXPECT_EQ(error_of(R"("scenes": [{"nodes": [0, 1, -1]}], "nodes": [{"mesh": 0}, {}], "materials": [{}])"),
            (folder_ / "t.gltf").string() + ": found a reference to node -1, there are 2");
}

// The second "asset" counts.
TEST_F(GltfImport, RefusesFilesWithoutVersion) {
  const char* rest = R"(, "scenes": [{"nodes": [0]}], "materials": [{}], "nodes": [{"mesh": 0}])";
  EXPECT_EQ(
      error_of(std::string(R"("asset": [{"version": "2.0"}])") + rest),
      (folder_ / "t.gltf").string() + ": has no asset.version: it is glTF 1 or no glTF, expected glTF 2");
  EXPECT_EQ(error_of(std::string(R"("asset": {"version": "1.0"})") + rest),
            (folder_ / "t.gltf").string() + ": is glTF 1.0, expected glTF 2");
}

// glTF's v runs downwards, t upwards.
TEST_F(GltfImport, FlipsTextureCoordinates) {
  const Model model = imported(
      R"("scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}], "textures": [{"source": 0}],
    "images": [{"uri": "none.png"}],
    "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}])",
      ModelUse::mesh, R"("POSITION": 0, "TEXCOORD_0": 1)");
  ASSERT_EQ(model.mesh.vertex_count(), 3u);
  ASSERT_EQ(model.mesh.texcoords.size(), 6u);
  const float expected[3][2] = {{1, 0}, {0.5f, 0.5f}, {0, 1}};
  for (std::size_t v = 0; v < 3; ++v) {
    std::size_t given = 0;  // vertex of the file with this position
    if (model.mesh.positions[3 * v] == 1) given = 1;
    else if (model.mesh.positions[3 * v + 1] == 1) given = 2;
    EXPECT_FLOAT_EQ(model.mesh.texcoords[2 * v], expected[given][0]);
    EXPECT_FLOAT_EQ(model.mesh.texcoords[2 * v + 1], expected[given][1]);
  }
  EXPECT_TRUE(imported(R"("scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}], "materials": [{"name": "m"}])")
                  .mesh.texcoords.empty());
}

// A camera or light shared by two nodes appears at both, even if the nodes have the same name.
TEST_F(GltfImport, KeepsSharedAndEquallyNamedLightsAndCameras) {
  const Model model = imported(
      R"("scenes": [{"nodes": [0, 1, 2, 3]}], "materials": [{"name": "m"}],
    "extensionsUsed": ["KHR_lights_punctual"],
    "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point"}]}},
    "cameras": [{"type": "perspective", "perspective": {"yfov": 1, "znear": 1}}],
    "nodes": [{"mesh": 0}, {"name": "Lamp", "translation": [1, 0, 0],
    "extensions": {"KHR_lights_punctual": {"light": 0}}},
              {"name": "Lamp", "translation": [2, 0, 0], "camera": 0,
    "extensions": {"KHR_lights_punctual": {"light": 0}}}, {"translation": [3, 0, 0], "camera": 0}])");
  ASSERT_EQ(model.lights.size(), 2u);
  EXPECT_FLOAT_EQ(model.lights[0].position[0], 1);
  EXPECT_FLOAT_EQ(model.lights[1].position[0], 2);
  ASSERT_EQ(model.cameras.size(), 2u);
  EXPECT_NEAR(model.cameras[1].view.m[3], -3, 1e-6);
}

TEST_F(GltfImport, ConvertsMaterials) {
  const Material m = material(
      R"({"pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.25, 1, 1], "metallicFactor": 0,
    "roughnessFactor": 0.5}, "emissiveFactor": [0, 0, 0.125]})");
  EXPECT_FLOAT_EQ(m.diffuse.g, srgb(0.25));
  EXPECT_FLOAT_EQ(m.ambient.b, 1);
  EXPECT_FLOAT_EQ(m.specular.r, 0.02f) << "0.04 / (1 + 4 / 4)";
  EXPECT_FLOAT_EQ(m.shininess, 30) << "2 / 0.5^4 - 2";
  EXPECT_FLOAT_EQ(m.emission.b, srgb(0.125));
  const Material metal = material(
      R"({"pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.25, 1, 1], "metallicFactor": 1,
    "roughnessFactor": 0}})");
  EXPECT_FLOAT_EQ(metal.specular.g, srgb(0.25));
  EXPECT_FLOAT_EQ(metal.shininess, 1024);
  const Material glossy = material(
      R"({"extensions": {"KHR_materials_pbrSpecularGlossiness": {"diffuseFactor": [0.1, 0.2, 0.3, 1],
    "specularFactor": [0.5, 0.6, 0.7], "glossinessFactor": 0.5}}})",
      R"(, "extensionsUsed": ["KHR_materials_pbrSpecularGlossiness"])");
  EXPECT_FLOAT_EQ(glossy.diffuse.g, srgb(0.2));
  EXPECT_FLOAT_EQ(glossy.specular.b, srgb(0.7) / 2) << "1 / (1 + 4 / 4)";
  EXPECT_FLOAT_EQ(glossy.shininess, 30);
  const Material unlit = material(
      R"({"pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.25, 1, 1]},
    "extensions": {"KHR_materials_unlit": {}}})",
      R"(, "extensionsUsed": ["KHR_materials_unlit"])");
  EXPECT_FLOAT_EQ(unlit.diffuse.g, srgb(0.25));
}

TEST_F(GltfImport, LeavesOutTexturesWithoutAnImage) {
  const Model model = imported(
      R"("scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}], "textures": [{"source": 0}],
    "images": [{"uri": "none.png"}],
    "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}, "emissiveFactor": [1, 1, 1],
    "emissiveTexture": {"index": 0}}])",
      ModelUse::display);
  EXPECT_FALSE(model.parts.at(0).texture.has_value());
  EXPECT_TRUE(model.images.empty());
  EXPECT_FLOAT_EQ(model.parts.at(0).material.emission.r, 0) << "the texture would modulate the emission";
  ASSERT_EQ(model.warnings.size(), 1u);
  EXPECT_NE(model.warnings[0].find("a texture is left out: cannot read"), std::string::npos);
}

TEST_F(GltfImport, MultipliesVertexColorsAndKeepsWindingOfMirroredNodes) {
  const Model model = imported(
      R"("scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0, "scale": [-1, 1, 1]}],
    "materials": [{"pbrMetallicRoughness": {"baseColorFactor": [0.5, 1, 1, 1]}}])",
      ModelUse::display, R"("POSITION": 0, "COLOR_0": 1)");
  ASSERT_EQ(model.mesh.colors.size(), 12u);
  EXPECT_TRUE(model.parts.at(0).uses_colors);
  EXPECT_FLOAT_EQ(model.mesh.colors[0], srgb(0.5));
  EXPECT_FLOAT_EQ(model.mesh.colors[4], srgb(0.25));
  // The mirrored triangle still faces +z.
  double area = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const float* const a = &model.mesh.positions[3 * model.mesh.indices[k]];
    const float* const b = &model.mesh.positions[3 * model.mesh.indices[(k + 1) % 3]];
    area += a[0] * b[1] - b[0] * a[1];
  }
  EXPECT_GT(area, 0);
  for (std::size_t v = 0; v < 3; ++v) EXPECT_FLOAT_EQ(model.mesh.normals[3 * v + 2], 1);
}

}  // namespace
}  // namespace tessera::gltf_import_test
