// Models in scene files: their materials, textures, coordinates, cameras and lights.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include <unistd.h>

#include "engine/program/scene/json_value.h"
#include "tests/engine/program/import/model_picture.h"

namespace tessera::file_model_test {
using namespace program;
using namespace model_picture;
using program::json::Json;
namespace {

using testing::HasSubstr;

/// A scene in the folder of the test's models.
Scene scene_of(const std::string& members) {
  return parse_scene(R"({"tessera": 1, "framebuffer": {"width": 240, "height": 180}, )" + members + "}",
                     "scene.json", kModels);
}

std::string message_of(const std::string& members) {
  try {
    scene_of(members);
  } catch (const Error& error) {
    return error.what();
  }
  return "(no error)";
}

/// Members of a scene with one mesh "m" from a file, and one draw of it with these keys.
std::string draws(const std::string& file, const std::string& keys = "") {
  return R"("meshes": {"m": {"file": ")" + file + R"("}}, "frame": [{"clear": {"color": )" +
         R"([0.18, 0.2, 0.25, 1], "depth": 1}}, {"draw": "m", "shading": "phong")" + keys + "}]";
}

/// The model as a scene draws it, with the camera and light of `tessera render MODEL`.
Picture draw_in_scene(const std::string& file, const std::string& keys = "") {
  const std::string path = kModels + file;
  const Model model = import_model(path, ModelUse::display);
  const Scene of_model = model_scene(model, path, 240, 180);
  Scene scene = scene_of(draws(file, keys));
  scene.camera = of_model.camera;
  scene.camera.view = scene.camera.view * translate(-model.origin.x, -model.origin.y, -model.origin.z);
  scene.lights = of_model.lights;
  for (Light& light : scene.lights) {
    if (light.position[3] == 0) continue;
    const double origin[] = {model.origin.x, model.origin.y, model.origin.z};
    for (std::size_t k = 0; k < 3; ++k) light.position[k] += static_cast<float>(origin[k]);
  }
  scene.light_model = of_model.light_model;
  return draw(scene);
}

const DrawCommand& draw_of(const Scene& scene, std::size_t command) {
  return std::get<DrawCommand>(scene.frame.at(command).value);
}

// Materials, textures, transparency, culling, normals and winding are those of the model.
TEST(FileModel, LooksAsRenderedAlone) {
  for (const char* const file :
       {"gltf/textured.gltf", "gltf/masked_leaf.gltf", "gltf/single_sided.gltf", "gltf/blended_window.gltf",
        "gltf/unlit_vertex_colors.gltf", "gltf/lines_beside_triangles.gltf", "obj/black_textured.obj",
        "obj/zero_normals.obj", "obj/smoothing_off.obj", "obj/vertex_colors.obj", "ply/face_colors.ply",
        "ply/triangle_strips.ply", "stl/magics_colors.stl", "threemf/color_group.3mf"}) {
    const Picture picture = draw_in_scene(file);
    EXPECT_EQ(picture.rgba, draw_model(file).rgba) << file;
    EXPECT_GT(count_pixels(picture, [](Pixel p) { return p != kBackground; }), 500) << file;
  }
}

// In the coordinates of the file: those of a scene's camera and other meshes.
TEST(FileModel, StaysFarFromTheOriginIfTheFileDoes) {
  const Scene scene = scene_of(draws("obj/far_from_origin.obj"));
  const Matrix& transform = draw_of(scene, 1).state.transform;
  EXPECT_GT(std::abs(transform.m[3]) + std::abs(transform.m[7]) + std::abs(transform.m[11]), 1e5);
  const Picture picture = draw_in_scene("obj/far_from_origin.obj");
  const Picture alone = draw_model("obj/far_from_origin.obj");
  int different = 0;
  for (int y = 0; y < alone.height; ++y)
    for (int x = 0; x < alone.width; ++x)
      for (std::size_t k = 0; k < 3; ++k)
        different += std::abs(pixel(picture, x, y)[k] - pixel(alone, x, y)[k]) > 2 ? 1 : 0;
  EXPECT_LT(different, 100);  // rounding of matrices at a distance of millions
}

TEST(FileModel, MaterialsOfTheSceneReplaceAllOfTheFile) {
  const Scene scene = scene_of(R"("materials": {"green": {"diffuse": [0, 1, 0, 1]}}, )" +
                               draws("gltf/masked_leaf.gltf", R"(, "material": "green")"));
  const DrawState& state = draw_of(scene, 1).state;
  EXPECT_THAT(state.material.diffuse, testing::FieldsAre(0, 1, 0, 1));
  EXPECT_EQ(state.texture, nullptr);
  EXPECT_FALSE(state.alpha_test);
  EXPECT_EQ(scene.frame.size(), 2u);
  EXPECT_EQ(scene.meshes.size(), 1u);
}

// Without a material, the file's; with one, the mesh without normals, which gets those of the draw.
TEST(FileModel, DrawsOfBothKindsAreIndependent) {
  const std::string with = R"(, "material": "green"}, {"draw": "m")";
  const std::string green = R"("materials": {"green": {"diffuse": [0, 1, 0, 1]}}, )";
  const Scene both = scene_of(green + draws("obj/zero_normals.obj", with));
  const Scene alone = scene_of(green + draws("obj/zero_normals.obj", R"(, "material": "green")"));
  const Scene own = scene_of(draws("obj/zero_normals.obj"));
  ASSERT_EQ(both.frame.size(), 3u);
  const auto indices = [](const Scene& scene, std::size_t command) {
    return scene.meshes[draw_of(scene, command).mesh].indices;
  };
  EXPECT_EQ(indices(both, 1), indices(alone, 1));
  EXPECT_EQ(indices(both, 2), indices(own, 1));
  EXPECT_FALSE(scene_of(draws("obj/zero_normals.obj")).meshes[draw_of(own, 1).mesh].normals.empty());
}

TEST(FileModel, KeysOfADrawOutrankTheFile) {
  const DrawState of_file = draw_of(scene_of(draws("gltf/masked_leaf.gltf")), 1).state;
  ASSERT_TRUE(of_file.alpha_test);
  EXPECT_EQ(of_file.alpha_test->func, Compare::gequal);
  ASSERT_NE(of_file.texture, nullptr);
  const Scene scene = scene_of(draws("gltf/masked_leaf.gltf",
                                     R"(, "alpha_test": {"func": "less", "ref": 0.25}, "cull": "front",
                                        "lighting": false, "color_material": "emission", "blend": {})"));
  const DrawState& state = draw_of(scene, 1).state;
  EXPECT_EQ(state.alpha_test->func, Compare::less);
  EXPECT_EQ(state.cull, Cull::front);
  EXPECT_FALSE(state.lighting);
  EXPECT_EQ(state.color_material, ColorMaterial::emission);
  EXPECT_TRUE(state.blend);
  EXPECT_NE(state.texture, nullptr);
}

TEST(FileModel, EachPartIsADrawAndTheDefaultFrameHasAll) {
  const std::string meshes =
      R"("meshes": {"w": {"file": "gltf/blended_window.gltf"}, "c": {"builtin": "cube"}})";
  const Scene scene = scene_of(meshes);
  // A clear, the box and the pane of the window, and the cube.
  ASSERT_EQ(scene.frame.size(), 4u);
  EXPECT_FALSE(draw_of(scene, 1).state.blend);
  EXPECT_TRUE(draw_of(scene, 2).state.blend);
  EXPECT_FALSE(draw_of(scene, 2).state.depth.write);
  EXPECT_EQ(scene.meshes[draw_of(scene, 3).mesh].name, "c");
}

TEST(FileModel, IndexBuffersGetOpaqueParts) {
  const Scene scene =
      parse_scene(R"({"tessera": 1, "framebuffer": {"color": {"mode": "index", "bits": 8}}, )" +
                      draws("gltf/blended_window.gltf") + "}",
                  "scene.json", kModels);
  EXPECT_FALSE(draw_of(scene, 2).state.blend);
  draw(scene);
}

TEST(FileModel, CamerasOfFilesAreUsedOnRequest) {
  const std::string file = "gltf/camera_of_file.gltf";
  const Scene alone = model_scene(import_model(kModels + file, ModelUse::display), file, 240, 180);
  const Scene scene = scene_of(R"("camera": {"file": "gltf/camera_of_file.gltf"}, )" + draws(file));
  EXPECT_EQ(scene.camera.view.m, alone.camera.view.m);
  EXPECT_EQ(scene.camera.at_aspect(1).projection.m, alone.camera.at_aspect(1).projection.m);
  EXPECT_THAT(message_of(R"("camera": {"file": "gltf/textured.gltf"}, "meshes": {})"),
              HasSubstr("/camera/file: found \"gltf/textured.gltf\", expected a model file with a camera"));
  EXPECT_THAT(message_of(R"("camera": {"file": "gltf/textured.gltf", "eye": [0, 0, 1]})"),
              HasSubstr("/camera/eye: unknown key"));
}

class FileModelLights : public testing::Test {
 protected:
  FileModelLights()
      : folder_(std::filesystem::temp_directory_path() / ("tessera_lights_" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(folder_);
  }
  ~FileModelLights() override { std::filesystem::remove_all(folder_); }
  std::filesystem::path folder_;
};

TEST_F(FileModelLights, AreUsedOnRequestAmongOthers) {
  std::ifstream plain(kModels + "gltf/linear_color.gltf");
  Json json = Json::parse(plain);
  json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}, {"intensity", 3.14159265}}};
  json["extensionsUsed"].push_back("KHR_lights_punctual");
  json["nodes"].push_back(
      {{"translation", {1, 2, 3}}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  json["scenes"][0]["nodes"].push_back(json["nodes"].size() - 1);
  std::ofstream(folder_ / "lit.gltf") << json;
  const Scene scene =
      parse_scene(R"({"tessera": 1, "lights": [{"position": [0, 1, 0, 0]}, {"file": "lit.gltf"}]})",
                  "scene.json", folder_.string());
  ASSERT_EQ(scene.lights.size(), 2u);
  EXPECT_THAT(scene.lights[0].position, testing::ElementsAre(0, 1, 0, 0));
  EXPECT_THAT(scene.lights[1].position, testing::ElementsAre(1, 2, 3, 1));
  EXPECT_THAT(message_of(R"("lights": [{"file": "gltf/textured.gltf"}])"),
              HasSubstr("/lights/0/file: found \"gltf/textured.gltf\", expected a model file with lights"));
}

}  // namespace
}  // namespace tessera::file_model_test
