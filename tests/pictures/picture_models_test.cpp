// Real models: the importer's result is written as a scene file, which the engine, the reference renderer and
// Mesa read independently and draw.
#include "engine/program/scene/model_scene.h"
#include "tests/pictures/model_list.h"
#include "tests/pictures/picture_harness.h"

#include <algorithm>
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <unistd.h>

namespace tessera::test::picture_models_test {
using namespace program;
namespace {

using nlohmann::json;

json in_groups(const std::vector<float>& numbers, std::size_t group) {
  json list = json::array();
  for (std::size_t i = 0; i < numbers.size(); i += group)
    list.push_back(std::vector<float>(numbers.begin() + static_cast<std::ptrdiff_t>(i),
                                      numbers.begin() + static_cast<std::ptrdiff_t>(i + group)));
  return list;
}

json components(const Color& c) { return {c.r, c.g, c.b, c.a}; }

json json_of(const Material& m) {
  return {{"ambient", components(m.ambient)},
          {"diffuse", components(m.diffuse)},
          {"specular", components(m.specular)},
          {"emission", components(m.emission)},
          {"shininess", m.shininess}};
}

json json_of(const Light& light) {
  return {
      {"ambient", components(light.ambient)},
      {"diffuse", components(light.diffuse)},
      {"specular", components(light.specular)},
      {"position", light.position},
      {"spot_direction", light.spot_direction},
      {"spot_exponent", light.spot_exponent},
      {"spot_cutoff", light.spot_cutoff},
      {"attenuation", {light.attenuation_constant, light.attenuation_linear, light.attenuation_quadratic}}};
}

json json_of(const Scene& scene) {
  const int width = scene.framebuffer.width, height = scene.framebuffer.height;
  const Camera camera = scene.camera.at_aspect(static_cast<double>(width) / height);
  json file = {{"tessera", 1},
               {"framebuffer", {{"width", width}, {"height", height}}},
               {"camera", {{"view", camera.view.m}, {"projection", camera.projection.m}}},
               {"light_model",
                {{"ambient", components(scene.light_model.ambient)},
                 {"local_viewer", scene.light_model.local_viewer},
                 {"two_sided", scene.light_model.two_sided}}},
               {"lights", json::array()},
               {"frame", json::array()}};
  for (const Light& light : scene.lights) file["lights"].push_back(json_of(light));
  for (const SceneCommand& command : scene.frame) {
    if (const auto* clear = std::get_if<Clear>(&command.value))
      file["frame"].push_back(
          {{"clear",
            {{"color", components(*clear->color)}, {"depth", *clear->depth}, {"stencil", *clear->stencil}}}});
    if (const auto* draw = std::get_if<DrawCommand>(&command.value)) {
      const MeshData& mesh = scene.meshes[draw->mesh];
      const std::string name = "m" + std::to_string(draw->mesh);
      file["meshes"][name] = {{"positions", in_groups(mesh.positions, 3)},
                              {"normals", in_groups(mesh.normals, 3)},
                              {"indices", mesh.indices}};
      if (!mesh.colors.empty()) file["meshes"][name]["colors"] = in_groups(mesh.colors, 4);
      file["materials"][name] = json_of(draw->state.material);
      file["frame"].push_back(
          {{"draw", name},
           {"material", name},
           {"shading", "phong"},
           {"color_material",
            draw->state.color_material == ColorMaterial::none ? "none" : "ambient_and_diffuse"}});
    }
  }
  return file;
}

std::string test_name(const testing::TestParamInfo<std::string>& info) {
  std::string name = std::filesystem::path(info.param).filename().string();
  std::ranges::replace_if(
      name, [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
  return name;
}

class PictureModel : public testing::TestWithParam<std::string> {};

TEST_P(PictureModel, MatchesReferenceAndMesa) {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("tessera_models_" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  const std::string path = (folder / (test_name({GetParam(), 0}) + ".json")).string();
  std::ofstream(path) << json_of(
      model_scene(import_model(GetParam(), ModelUse::display), GetParam(), 160, 120));
  const ThreeWayReport report = compare_three_ways(path);
  std::filesystem::remove_all(folder);
  EXPECT_TRUE(report.mesa_cannot.empty()) << report.mesa_cannot;
  if (!report.is_good()) ADD_FAILURE() << report.text() << "\n  pictures in " << write_pictures(report);
}

INSTANTIATE_TEST_SUITE_P(Models, PictureModel, testing::ValuesIn(page_models()), test_name);

}  // namespace
}  // namespace tessera::test::picture_models_test
