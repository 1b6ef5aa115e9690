// Models of all formats, from Debian's assimp-testmodels: intact and broken files, within the limits of time
// and memory.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>

#include <unistd.h>

#include "engine/program/import/model.h"
#include "engine/program/scene/file_extension.h"
#include "engine/program/scene/model_scene.h"

namespace tessera::model_import_test {
using namespace program;
namespace {

namespace fs = std::filesystem;

const fs::path kModels = "/usr/share/assimp/models";

class ModelImport : public testing::Test {
 protected:
  ModelImport() : folder_(fs::temp_directory_path() / ("tessera_models_" + std::to_string(::getpid()))) {
    fs::create_directories(folder_);
  }
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

// Expects a picture or an Error of one line, in time. Returns whether the model was read.
bool renders(const std::string& path) {
  static Renderer renderer;
  const auto start = std::chrono::steady_clock::now();
  bool is_read = false;
  try {
    const Model model = import_model(path, ModelUse::display);
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
  const Model stl = import_model(write("t.stl",
                                       "solid t\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 2 0 "
                                       "0\nvertex 0 3 0\nendloop\nendfacet\nendsolid t\n"));
  ASSERT_EQ(stl.mesh.indices.size(), 3u);
  EXPECT_EQ(stl.mesh.vertex_count(), 3u);
  EXPECT_FLOAT_EQ(*std::max_element(stl.mesh.positions.begin(), stl.mesh.positions.end()), 3);
  const Model ply = import_model(
      write("t.ply",
            "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float "
            "z\nelement face 1\n"
            "property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n"));
  EXPECT_EQ(ply.mesh.indices.size(), 6u);
  for (std::size_t i = 2; i < ply.mesh.normals.size(); i += 3)
    EXPECT_FLOAT_EQ(std::abs(ply.mesh.normals[i]), 1);
}

// One model in six formats has the same number of triangles and the same picture, except for normals, which
// only some of the files give.
TEST_F(ModelImport, RendersOneModelAlikeFromSixFormats) {
  std::vector<std::uint8_t> first;
  for (const char* name : {"OBJ/WusonOBJ.obj", "PLY/Wuson.ply", "STL/Wuson.stl", "OFF/Wuson.off",
                           "MS3D/Wuson.ms3d", "XGL/Wuson.zgl"}) {
    const Model model = import_model((kModels / name).string(), ModelUse::display);
    EXPECT_EQ(model.mesh.indices.size() / 3, 3732u) << name;
    Scene scene = model_scene(model, name, 320, 240);
    for (SceneCommand& command : scene.frame)
      if (auto* draw = std::get_if<DrawCommand>(&command.value)) draw->state.material = {};
    FrameBuffer buffer(scene.framebuffer);
    Frame frame(buffer);
    record(scene, frame);
    std::vector<std::uint8_t> pixels(4 * 320 * 240);
    Renderer().finish(frame, {.pixels = pixels.data(), .width = 320, .height = 240, .stride_bytes = 4 * 320});
    if (first.empty()) first = pixels;
    std::size_t covered = 0;
    std::size_t other_outline = 0;
    std::size_t other_shade = 0;
    const auto is_background = [](const std::uint8_t* p) { return p[0] == 46 && p[1] == 51 && p[2] == 64; };
    for (std::size_t i = 0; i < pixels.size(); i += 4) {
      covered += is_background(&pixels[i]) ? 0 : 1;
      other_outline += is_background(&pixels[i]) != is_background(&first[i]) ? 1 : 0;
      other_shade += std::abs(pixels[i] - first[i]) > 40 ? 1 : 0;
    }
    EXPECT_GT(covered, 8000u) << name;
    EXPECT_LT(other_outline, covered / 100) << name;
    EXPECT_LT(other_shade, covered / 10) << name << ": flat normals differ at edges";
  }
}

TEST_F(ModelImport, ReadsColorsOfManyVerticesInTime) {
#ifdef __SANITIZE_THREAD__  // a dozen times slower, with the same limit of ten seconds
  constexpr int kSide = 200;
#else
  constexpr int kSide = 400;
#endif
  std::string text =
      "ply\nformat ascii 1.0\nelement vertex " + std::to_string(kSide * kSide) +
      "\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\nproperty uchar green\n"
      "property uchar blue\nelement face " +
      std::to_string((kSide - 1) * (kSide - 1)) + "\nproperty list uchar int vertex_indices\nend_header\n";
  for (int i = 0; i < kSide * kSide; ++i)
    text += std::to_string(i % kSide) + " " + std::to_string(i / kSide) + " 0 255 0 51\n";
  for (int y = 0; y + 1 < kSide; ++y)
    for (int x = 0; x + 1 < kSide; ++x) {
      const int v = y * kSide + x;
      text += "4 " + std::to_string(v) + " " + std::to_string(v + 1) + " " + std::to_string(v + kSide + 1) +
              " " + std::to_string(v + kSide) + "\n";
    }
  const Model model = import_model(write("colors.ply", text));
  ASSERT_EQ(model.mesh.colors.size(), 4u * kSide * kSide);
  EXPECT_FLOAT_EQ(model.mesh.colors[2], 0.2f);
  EXPECT_TRUE(model.parts.at(0).uses_colors);
}

// lights.dae holds a point light with a quadratic term, a sun, a spot of 45 degrees and an ambient light.
TEST_F(ModelImport, ReadsColladaLights) {
  const Model model = import_model((kModels / "Collada/lights.dae").string());
  ASSERT_GE(model.lights.size(), 3u);
  const auto sun = std::find_if(model.lights.begin(), model.lights.end(),
                                [](const Light& l) { return l.position[3] == 0; });
  const auto spot = std::find_if(model.lights.begin(), model.lights.end(),
                                 [](const Light& l) { return l.spot_cutoff != 180; });
  ASSERT_TRUE(sun != model.lights.end() && spot != model.lights.end());
  EXPECT_NEAR(spot->spot_cutoff, 45, 1e-3);
  EXPECT_NEAR(spot->attenuation_quadratic, 0.00159997, 1e-7);
  ASSERT_TRUE(model.ambient_light.has_value());
  EXPECT_FLOAT_EQ(model.ambient_light->g, 1);
}

// The readers of OBJ, glTF, PLY, STL, 3MF, and assimp.
TEST(ModelProgress, IsReportedByEveryReader) {
  const std::string own = TESSERA_SOURCE_DIR "/tests/models/";
  for (const std::string& path : {own + "obj/textured.obj", own + "gltf/textured.gltf",
                                  own + "ply/face_colors.ply", own + "stl/magics_colors.stl",
                                  own + "threemf/color_group.3mf", (kModels / "Collada/duck.dae").string()}) {
    std::vector<double> shares;
    import_model(path, ModelUse::display,
                 {.progress = [&](const std::string&, double done) { shares.push_back(done); }});
    EXPECT_FALSE(shares.empty()) << path;
    EXPECT_TRUE(std::ranges::is_sorted(shares)) << path;
    for (const double done : shares) EXPECT_TRUE(done >= 0 && done <= 1) << path << ": " << done;
  }
}

// Reads assimp's corpus; then the smallest file of each format, empty, truncated and with random bytes
// changed.
TEST_F(ModelImport, RendersOrRejectsEveryModelInOneLine) {
  int read = 0;
  int refused = 0;
  std::map<std::string, fs::path> smallest;
  const std::vector<std::string> endings = model_extensions();
  for (const auto& entry : fs::recursive_directory_iterator(kModels)) {
    const std::string ending = lower_case_extension(entry.path().string());
    if (!entry.is_regular_file() || std::find(endings.begin(), endings.end(), ending) == endings.end())
      continue;
    const bool is_read = renders(entry.path().string());
    ++(is_read ? read : refused);
    fs::path& of_format = smallest[ending];
    if (is_read && (of_format.empty() || fs::file_size(of_format) > entry.file_size()))
      of_format = entry.path();
  }
  std::erase_if(smallest, [](const auto& format) { return format.second.empty(); });
  EXPECT_GE(read, 300);
  EXPECT_GE(smallest.size(), 40u);
  int broken_read = 0;
  int broken_refused = 0;
  std::uint32_t random = 1;
  for (const auto& [ending, path] : smallest) {
    const std::string whole = content(path);
    std::vector<std::string> broken = {"", whole.substr(0, 1), whole.substr(0, whole.size() / 3),
                                       whole.substr(0, whole.size() - 1)};
    for (const int bytes : {1, 5, 20, 100}) {
      std::string& scrambled = broken.emplace_back(whole);
      for (int i = 0; i < bytes; ++i) {
        random = random * 1664525 + 1013904223;
        scrambled[(random >> 8) % scrambled.size()] = static_cast<char>(random >> 24);
      }
    }
    for (const std::string& text : broken)
      ++(renders(write("broken" + ending, text)) ? broken_read : broken_refused);
    EXPECT_FALSE(renders(write("empty" + ending, ""))) << ending;
  }
  EXPECT_GT(broken_refused, 100);
  EXPECT_GT(broken_read, 20);
  std::printf("%d models drawn, %d refused, %zu formats; broken files: %d drawn, %d refused\n", read, refused,
              smallest.size(), broken_read, broken_refused);
}

}  // namespace
}  // namespace tessera::model_import_test
