// Scene files of models: reading them gives the same picture.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

#include <unistd.h>

#include "engine/program/scene/json_value.h"
#include "engine/program/scene/write_scene.h"
#include "tests/engine/program/import/model_picture.h"
#include "tests/pictures/model_list.h"

namespace tessera::write_scene_test {
using namespace program;
using program::json::Json;
namespace {

namespace fs = std::filesystem;

class WriteScene : public testing::Test {
 protected:
  WriteScene() : folder_(fs::temp_directory_path() / ("tessera_write_scene_" + std::to_string(::getpid()))) {
    fs::create_directories(folder_);
  }
  ~WriteScene() override { fs::remove_all(folder_); }

  std::string path() const { return (folder_ / "model.json").string(); }
  /// The scene file as JSON.
  Json written(const Scene& scene) const {
    write_scene(scene, path());
    std::ifstream file(path());
    return Json::parse(file);
  }
  std::vector<std::uint8_t> pixels_of_file(const Scene& scene) const {
    write_scene(scene, path());
    return model_picture::draw(load_scene(path())).rgba;
  }

  fs::path folder_;
};

Scene scene_of(const std::string& model) {
  return model_scene(import_model(model, ModelUse::display), model, 96, 72);
}

/// A triangle for each colour, at z 0, 1, ..., each a separate part.
Model triangles(const std::vector<Color>& colors) {
  Model model;
  for (const Color& color : colors) {
    const auto first = static_cast<std::uint32_t>(model.mesh.vertex_count());
    const auto z = static_cast<float>(model.parts.size());
    model.mesh.positions.insert(model.mesh.positions.end(), {-1, -1, z, 1, -1, z, 0, 1, z});
    model.mesh.normals.insert(model.mesh.normals.end(), {0, 0, 1, 0, 0, 1, 0, 0, 1});
    ModelPart part;
    part.material_name = "paint";
    part.material.diffuse = color;
    part.first_index = model.mesh.indices.size();
    part.index_count = 3;
    model.mesh.indices.insert(model.mesh.indices.end(), {first, first + 1, first + 2});
    model.parts.push_back(part);
  }
  return model;
}

TEST_F(WriteScene, GivesTheSamePicture) {
  std::vector<std::string> models;
  for (const char* name :
       {"blended_window.gltf", "camera_of_file.gltf", "linear_color.gltf", "lines.gltf",
        "lines_beside_triangles.gltf", "masked_leaf.gltf", "morph_weights.gltf", "quantized.gltf",
        "single_sided.gltf", "skin.gltf", "textured.gltf", "unlit_vertex_colors.gltf"})
    models.push_back(test::kOwnModels + name);
  for (const char* name : {"3DS/cubes_with_alpha.3DS", "Collada/duck.dae", "LWO/LWO2/transparency.lwo",
                           "MS3D/jeep1.ms3d", "BVH/01_01.bvh"})
    if (fs::exists(test::kAssimpModels + name)) models.push_back(test::kAssimpModels + name);
  for (const std::string& model : models) {
    const Scene scene = scene_of(model);
    EXPECT_TRUE(pixels_of_file(scene) == model_picture::draw(scene).rgba) << model;
  }
}

TEST_F(WriteScene, KeepsOverriddenCameraLightsAndSize) {
  Scene scene = scene_of(test::kOwnModels + "blended_window.gltf");
  apply({.width = 50,
         .height = 70,
         .camera = camera_at({.eye = {-2, 1, -4}}, {.near = 0.5}),
         .lights = {{.position = {1, 2, 3, 1}, .spot_exponent = 2, .spot_cutoff = 40}, {}}},
        scene);
  EXPECT_TRUE(pixels_of_file(scene) == model_picture::draw(scene).rgba);
  const Json file = written(scene);
  EXPECT_EQ(file["camera"]["eye"], Json({-2, 1, -4}));
  EXPECT_EQ(file["camera"]["projection"]["fovy"], 45);
  EXPECT_EQ(file["lights"].size(), 2u);
}

TEST_F(WriteScene, TexturesKeepAlphaAndHiddenColors) {
  Model model = triangles({{1, 1, 1, 1}});
  model.mesh.texcoords = {0, 0, 1, 0, 0, 1};
  model.images = {ModelImage{.width = 2,
                             .height = 2,
                             .has_alpha = true,
                             .pixels = {200, 10, 30, 0, 1, 2, 3, 128, 40, 50, 60, 255, 255, 0, 0, 1}}};
  model.textures = {{.sampler = {.mag = TextureFilter::nearest, .wrap_t = TextureWrap::mirrored_repeat}}};
  model.parts[0].texture = 0;
  model.parts[0].alpha = ModelAlpha::mask;
  model.parts[0].alpha_cutoff = 0.3f;
  const std::vector<std::uint8_t> pixels = model.images[0].pixels;
  const Scene scene = model_scene(std::move(model), "textured", 64, 48);
  const Json file = written(scene);
  EXPECT_EQ(file["textures"]["texture0"], Json({{"file", "model.texture0.png"},
                                                {"mag", "nearest"},
                                                {"min", "linear_mipmap_linear"},
                                                {"wrap_s", "repeat"},
                                                {"wrap_t", "mirrored_repeat"}}));
  const Picture texture = read_picture((folder_ / "model.texture0.png").string());
  EXPECT_EQ(texture.channels, 4);
  EXPECT_EQ(texture.rgba, pixels);
  EXPECT_TRUE(pixels_of_file(scene) == model_picture::draw(scene).rgba);
}

TEST_F(WriteScene, WritesASharedImageOnce) {
  Model model = triangles({{1, 1, 1, 1}, {1, 1, 1, 1}});
  model.mesh.texcoords.assign(12, 0.5f);
  model.images = {ModelImage{.width = 1, .height = 1, .pixels = {1, 2, 3, 255}}};
  model.textures = {{}, {.sampler = {.mag = TextureFilter::nearest}}};
  for (std::size_t i = 0; i < 2; ++i) model.parts[i].texture = i;
  const Json file = written(model_scene(std::move(model), "twice"));
  EXPECT_EQ(file["textures"]["texture1"]["file"], "model.texture0.png");
  EXPECT_TRUE(fs::exists(folder_ / "model.texture0.png"));
  EXPECT_FALSE(fs::exists(folder_ / "model.texture1.png"));
}

TEST_F(WriteScene, NamesAreUniqueAndEqualMaterialsShared) {
  Model model = triangles({{1, 0, 0, 1}, {0, 1, 0, 1}, {1, 0, 0, 1}});
  model.parts[2].material_name = "gl\xe4nzend";
  const Json file = written(model_scene(std::move(model), "names"));
  std::vector<std::string> meshes, materials;
  for (const auto& [name, mesh] : file["meshes"].items()) meshes.push_back(name);
  for (const auto& [name, material] : file["materials"].items()) materials.push_back(name);
  EXPECT_EQ(meshes, (std::vector<std::string>{"paint", "paint 2", "gl\xef\xbf\xbdnzend"}));
  EXPECT_EQ(materials, (std::vector<std::string>{"paint", "paint 2"}));
  EXPECT_EQ(file["frame"][3]["material"], "paint");
}

TEST_F(WriteScene, MeshesHoldOnlyWhatTheirDrawsUse) {
  Model model = triangles({{1, 0, 0, 0.5f}, {0, 1, 0, 1}, {0, 0, 1, 0.5f}});
  model.mesh.texcoords.assign(18, 0.25f);
  model.parts[0].alpha = model.parts[2].alpha = ModelAlpha::blend;
  model.parts[1].is_unlit = true;
  const Scene scene = model_scene(std::move(model), "parts");
  const Json file = written(scene);
  ASSERT_EQ(file["frame"].size(), 4u);
  for (const auto& [name, mesh] : file["meshes"].items()) {
    EXPECT_EQ(mesh["positions"].size(), 3u);
    EXPECT_EQ(mesh["indices"], Json({0, 1, 2}));
    EXPECT_FALSE(mesh.contains("texcoords"));
  }
  EXPECT_FALSE(file["meshes"]["paint"].contains("normals"));
  EXPECT_EQ(file["frame"][1]["lighting"], false);
  EXPECT_EQ(file["frame"][2]["depth"]["write"], false);
  EXPECT_EQ(file["frame"][2]["blend"]["src"], "src_alpha");
  EXPECT_TRUE(pixels_of_file(scene) == model_picture::draw(scene).rgba);
}

TEST_F(WriteScene, LeavesOutWhatIsNotFinite) {
  Model model = triangles({{1, 0, 0, 1}, {0, 1, 0, 1}});
  model.mesh.positions[10] = std::numeric_limits<float>::infinity();
  const Scene scene = model_scene(std::move(model), "infinite");
  EXPECT_EQ(written(scene)["meshes"].size(), 1u);
  EXPECT_TRUE(pixels_of_file(scene) == model_picture::draw(scene).rgba);

  model = triangles({{1, 0, 0, 1}});
  model.mesh.normals[4] = std::nanf("");
  try {
    write_scene(model_scene(std::move(model), "m.ply"), path());
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(std::string(error.what()),
              "m.ply: normals of mesh \"paint\" hold a number that is not finite, "
              "which a scene file cannot store");
  }
}

}  // namespace
}  // namespace tessera::write_scene_test
