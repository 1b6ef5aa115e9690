// Models of all formats: Debian's assimp-testmodels, whole ones and broken ones, each within its limits.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <csignal>
#include <new>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <thread>

#include <unistd.h>

#include "engine/import/child_process.h"
#include "engine/import/model.h"
#include "engine/import/model_bytes.h"
#include "engine/scene/file_ending.h"
#include "engine/scene/model_scene.h"

namespace tessera {
namespace {

namespace fs = std::filesystem;

const fs::path kModels = "/usr/share/assimp/models";

class ModelImport : public testing::Test {
 protected:
  ModelImport() : folder_(fs::temp_directory_path() / ("tessera_models_" + std::to_string(::getpid()))) { fs::create_directories(folder_); }
  ~ModelImport() override { fs::remove_all(folder_); }
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return (folder_ / name).string();
  }
  fs::path folder_;
};

std::string content(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

// A picture or one Error of one line, in time; anything else ends the test.
bool renders(const std::string& path) {
  static Renderer renderer;
  const auto start = std::chrono::steady_clock::now();
  bool is_read = false;
  try {
    const Model model = import_model(path);
    EXPECT_FALSE(model.parts.empty()) << path;
    for (const std::uint32_t index : model.mesh.indices) EXPECT_LT(index, model.mesh.vertex_count());
    std::size_t covered = 0;
    for (const ModelPart& part : model.parts) covered += part.index_count;
    EXPECT_EQ(covered, model.mesh.indices.size()) << path;
    const Scene scene = model_scene(model, path, 64, 48);
    FrameBuffer buffer(scene.framebuffer);
    Frame frame(buffer);
    record(scene, frame);
    EXPECT_GT(renderer.finish(frame).triangles_in, 0u) << path;
    is_read = true;
  } catch (const Error& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find(path), std::string::npos) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(12)) << path;
  return is_read;
}

TEST_F(ModelImport, ReadsPlyAndStl) {
  const Model stl = import_model(write("t.stl", "solid t\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 2 0 0\nvertex 0 3 0\nendloop\nendfacet\nendsolid t\n"));
  ASSERT_EQ(stl.mesh.indices.size(), 3u);
  EXPECT_EQ(stl.mesh.vertex_count(), 3u);
  EXPECT_FLOAT_EQ(*std::max_element(stl.mesh.positions.begin(), stl.mesh.positions.end()), 3);
  const Model ply = import_model(write("t.ply", "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"
                                                "property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n"));
  EXPECT_EQ(ply.mesh.indices.size(), 6u);
  for (std::size_t i = 2; i < ply.mesh.normals.size(); i += 3) EXPECT_FLOAT_EQ(std::abs(ply.mesh.normals[i]), 1);
}

// Written here from the glTF 2 specification: two nodes, a camera and three lights.
TEST_F(ModelImport, ReadsNodesCamerasLightsAndMaterialsOfGltf) {
  const float positions[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  write("t.bin", std::string(reinterpret_cast<const char*>(positions), sizeof positions));
  const Model model = import_model(write("t.gltf", R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1, 2, 3, 4]}],
    "extensionsUsed": ["KHR_lights_punctual"],
    "extensions": {"KHR_lights_punctual": {"lights": [{"type": "directional", "intensity": 3, "color": [1, 0.5, 0]}, {"type": "point", "intensity": 10}, {"type": "spot", "intensity": 5, "spot": {"outerConeAngle": 0.5}}]}},
    "nodes": [{"mesh": 0, "translation": [5, 0, 0], "scale": [2, 2, 2]}, {"camera": 0, "translation": [0, 0, 7]},
              {"extensions": {"KHR_lights_punctual": {"light": 0}}}, {"extensions": {"KHR_lights_punctual": {"light": 1}}, "translation": [1, 2, 3]},
              {"extensions": {"KHR_lights_punctual": {"light": 2}}}],
    "cameras": [{"type": "perspective", "perspective": {"yfov": 0.8, "aspectRatio": 1.5, "znear": 0.5, "zfar": 50}}],
    "materials": [{"name": "m", "pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.25, 1, 1], "metallicFactor": 0, "roughnessFactor": 0.5}, "emissiveFactor": [0, 0, 0.125]}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}],
    "bufferViews": [{"buffer": 0, "byteLength": 36}], "buffers": [{"uri": "t.bin", "byteLength": 36}]})"));
  ASSERT_EQ(model.mesh.vertex_count(), 3u);
  EXPECT_FLOAT_EQ(*std::max_element(model.mesh.positions.begin(), model.mesh.positions.end()), 7) << "5 + 2 * 1";
  ASSERT_EQ(model.parts.size(), 1u);
  const Material& m = model.parts[0].material;
  EXPECT_FLOAT_EQ(m.diffuse.g, 0.25f);
  EXPECT_FLOAT_EQ(m.specular.r, 0.02f) << "0.04 / (1 + 4 / 4)";
  EXPECT_FLOAT_EQ(m.shininess, 30) << "2 / 0.5^4 - 2";
  EXPECT_FLOAT_EQ(m.emission.b, 0.125f);
  ASSERT_EQ(model.cameras.size(), 1u);
  EXPECT_NEAR(model.cameras[0].half_height, std::tan(0.4), 1e-6);
  EXPECT_NEAR(model.cameras[0].view.m[11], -7, 1e-6);
  EXPECT_FLOAT_EQ(static_cast<float>(model.cameras[0].near), 0.5f);
  ASSERT_EQ(model.lights.size(), 3u);
  EXPECT_FLOAT_EQ(model.lights[0].position[3], 0);
  EXPECT_FLOAT_EQ(model.lights[0].position[2], 1) << "it shines along -z";
  EXPECT_NEAR(model.lights[0].diffuse.g, 1.5 / 3.14159265, 1e-5);
  EXPECT_FLOAT_EQ(model.lights[1].position[1], 2);
  EXPECT_FLOAT_EQ(model.lights[1].attenuation_quadratic, 1);
  EXPECT_NEAR(model.lights[2].spot_cutoff, 0.5 * 180 / 3.14159265, 1e-3);
  // Between the axis and 0.5, glTF's ramp ((cos t - cos 0.5) / (1 - cos 0.5))^2 is 1/2 at this angle.
  const double cosine = std::cos(0.5) + std::sqrt(0.5) * (1 - std::cos(0.5));
  EXPECT_NEAR(std::pow(cosine, model.lights[2].spot_exponent), 0.5, 1e-4);
  const Scene scene = model_scene(model, "t", 64, 48);
  EXPECT_EQ(scene.lights.size(), 3u);
}

// What is in all files of one animal is the same shape, whatever reader brought it: as many triangles, and the same proportions.
TEST_F(ModelImport, OneModelIsTheSameInSixFormats) {
  std::array<double, 3> expected{};
  for (const char* name : {"OBJ/WusonOBJ.obj", "PLY/Wuson.ply", "STL/Wuson.stl", "OFF/Wuson.off", "X/Testwuson.X", "MS3D/Wuson.ms3d"}) {
    const Model model = import_model((kModels / name).string());
    std::array<double, 3> low{1e9, 1e9, 1e9}, high{-1e9, -1e9, -1e9};
    for (std::size_t i = 0; i < model.mesh.positions.size(); ++i) {
      low[i % 3] = std::min<double>(low[i % 3], model.mesh.positions[i]);
      high[i % 3] = std::max<double>(high[i % 3], model.mesh.positions[i]);
    }
    std::array<double, 3> size;
    for (std::size_t k = 0; k < 3; ++k) size[k] = high[k] - low[k];
    std::sort(size.begin(), size.end());  // some are lying, some are standing
    for (double& x : size) x /= size[2] > 0 ? size[2] : 1;
    if (expected[2] == 0) expected = size;
    EXPECT_EQ(model.mesh.indices.size() / 3, 3732u) << name;
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(size[k], expected[k], 1e-3) << name;
  }
}

// The corpus of assimp, whole and broken files; then the smallest file of each format: empty, cut off, and with wrong bytes.
TEST_F(ModelImport, EveryModelOfEveryFormatIsAPictureOrRefusedInOneLine) {
  int read = 0, refused = 0;
  std::map<std::string, fs::path> smallest;
  const std::vector<std::string> endings = model_endings();
  for (const auto& entry : fs::recursive_directory_iterator(kModels)) {
    const std::string ending = lower_case_ending(entry.path().string());
    if (!entry.is_regular_file() || std::find(endings.begin(), endings.end(), ending) == endings.end()) continue;
    const bool is_read = renders(entry.path().string());
    ++(is_read ? read : refused);
    fs::path& of_format = smallest[ending];
    if (is_read && (of_format.empty() || fs::file_size(of_format) > entry.file_size())) of_format = entry.path();
  }
  std::erase_if(smallest, [](const auto& format) { return format.second.empty(); });
  EXPECT_GE(read, 250);
  EXPECT_GE(smallest.size(), 40u);
  int broken_read = 0, broken_refused = 0;
  std::uint32_t random = 1;
  for (const auto& [ending, path] : smallest) {
    const std::string whole = content(path);
    std::vector<std::string> broken = {"", whole.substr(0, 1), whole.substr(0, whole.size() / 3), whole.substr(0, whole.size() - 1)};
    for (const int bytes : {1, 5, 20, 100}) {
      std::string& scrambled = broken.emplace_back(whole);
      for (int i = 0; i < bytes; ++i) {
        random = random * 1664525 + 1013904223;
        scrambled[(random >> 8) % scrambled.size()] = static_cast<char>(random >> 24);
      }
    }
    for (const std::string& text : broken) ++(renders(write("broken" + ending, text)) ? broken_read : broken_refused);
    EXPECT_FALSE(renders(write("empty" + ending, ""))) << ending;
  }
  EXPECT_GT(broken_refused, 100);
  EXPECT_GT(broken_read, 20);
  std::printf("%d models drawn, %d refused, %zu formats; of broken files %d drawn, %d refused\n", read, refused, smallest.size(), broken_read, broken_refused);
}

TEST_F(ModelImport, BytesComeBackAsTheModelTheyWere) {
  Model model{.mesh = {}, .parts = {{.material_name = "a", .material = {.shininess = 3}, .first_index = 0, .index_count = 3}}, .warnings = {"w"}, .cameras = {{.half_height = 30}}, .lights = {Light{}}};
  model.mesh.positions = {1, 2, 3};
  model.mesh.indices = {0, 0, 0};
  const std::string bytes = to_bytes(model);
  const Model back = model_from_bytes(bytes);
  EXPECT_EQ(back.mesh.positions, model.mesh.positions);
  EXPECT_EQ(back.parts.at(0).material_name, "a");
  EXPECT_EQ(back.parts.at(0).material.shininess, 3);
  EXPECT_EQ(back.warnings, model.warnings);
  EXPECT_EQ(back.cameras.at(0).half_height, 30);
  for (std::size_t size = 0; size < bytes.size(); ++size) EXPECT_THROW(model_from_bytes(bytes.substr(0, size)), Error);
}

TEST(ChildProcess, IsStoppedByItsLimitsAndSaysWhy) {
  const auto message = [](const ChildLimits& limits, const std::function<std::string()>& work) {
    try {
      return "result " + run_in_child("file", limits, work);
    } catch (const Error& error) {
      return std::string(error.what());
    }
  };
  EXPECT_EQ(message({}, [] { return std::string(200000, 'x'); }), "result " + std::string(200000, 'x'));
  EXPECT_EQ(message({}, []() -> std::string { throw Error("file:3: bad"); }), "file:3: bad");
  EXPECT_NE(message({.time = std::chrono::milliseconds(300)}, [] {
              std::this_thread::sleep_for(std::chrono::seconds(30));
              return std::string();
            }).find("took more than"), std::string::npos);
  EXPECT_NE(message({}, []() -> std::string { std::abort(); }).find("broke down"), std::string::npos);
  EXPECT_NE(message({.result_bytes = 1 << 20}, [] { return std::string(3 << 20, 'x'); }).find("gives 3 MiB, at most 1 MiB"), std::string::npos);
  EXPECT_NE(message({}, []() -> std::string { throw std::bad_alloc(); }).find("1024 MiB"), std::string::npos);
  EXPECT_NE(message({}, []() -> std::string { throw 3; }).find("no known kind"), std::string::npos);
  EXPECT_NE(message({}, []() -> std::string { ::raise(SIGINT); return ""; }).find("interrupted"), std::string::npos);
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  EXPECT_NE(message({.memory_bytes = std::size_t{1} << 30}, [] { return std::string(std::size_t{3} << 30, 'x'); }).find("1024 MiB"), std::string::npos);
#endif
}

}  // namespace
}  // namespace tessera
