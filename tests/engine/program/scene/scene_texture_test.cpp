// Textures of scene files: channels and keys, caching, and errors of unreadable files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include <unistd.h>

#include "engine/program/scene/scene.h"
#include "tests/engine/frame/api_support.h"

namespace tessera::scene_texture_test {
using namespace program;
namespace {

namespace fs = std::filesystem;
using namespace test;
using testing::AllOf;
using testing::HasSubstr;

class SceneTexture : public testing::Test {
 protected:
  SceneTexture() : folder_(fs::temp_directory_path() / ("tessera_texture_" + std::to_string(::getpid()))) {
    fs::create_directories(folder_);
  }
  ~SceneTexture() override { fs::remove_all(folder_); }

  std::string write(const std::string& name, const std::string& bytes) const {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
    return (folder_ / name).string();
  }
  Scene parse(const std::string& rest) const {
    return parse_scene("{\"tessera\": 1, " + rest + "}", "scene.json", folder_.string());
  }
  std::string error(const std::string& file) const {
    return error_of([&] { parse("\"textures\": {\"t\": {\"file\": \"" + file + "\"}}"); })
        .value_or("(no error)");
  }

  fs::path folder_;
};

const std::string kTextures = TESSERA_TEST_SCENES "/textures/";

TEST_F(SceneTexture, KeepsChannelsOfFiles) {
  const Scene scene =
      parse("\"textures\": {\"g\": {\"file\": \"" + kTextures + "letter_grey.png\"}, \"ga\": {\"file\": \"" +
            kTextures + "letter_grey_alpha.png\"}, \"rgb\": {\"file\": \"" + kTextures +
            "letter_rgb.png\"}, \"rgba\": {\"file\": \"" + kTextures + "letter_rgba.png\"}}");
  ASSERT_EQ(scene.textures.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(scene.textures[i]->channels(), static_cast<int>(i) + 1);
    EXPECT_EQ(scene.textures[i]->width(), 8);
    EXPECT_EQ(scene.textures[i]->height(), 8);
  }
}

TEST_F(SceneTexture, ReadsAllKeys) {
  write("a.ppm", std::string("P6 2 1 255\n") + "abcdef");
  const Scene scene = parse(R"("textures": {"plain": {"file": "a.ppm"},
    "t": {"file": "a.ppm", "mag": "nearest", "min": "nearest_mipmap_linear", "wrap_s": "clamp_to_edge",
    "wrap_t": "mirrored_repeat"}},
    "meshes": {"m": {"positions": [[0,0,0],[1,0,0],[0,1,0]], "texcoords": [[0,0.5],[1,2],[3,-4]]}},
    "frame": [{"draw": "m"}, {"draw": "m", "texture": "t", "texture_env": "blend",
    "texture_env_color": [0.5, 2, -1, 0.25]}])");
  ASSERT_EQ(scene.textures.size(), 2u);
  EXPECT_EQ(scene.textures[0]->sampler().mag, TextureFilter::linear);
  EXPECT_EQ(scene.textures[0]->sampler().min, TextureFilter::linear_mipmap_linear);
  EXPECT_EQ(scene.textures[0]->sampler().wrap_s, TextureWrap::repeat);
  EXPECT_EQ(scene.textures[0]->sampler().wrap_t, TextureWrap::repeat);
  const TextureSampler& sampler = scene.textures[1]->sampler();
  EXPECT_EQ(sampler.mag, TextureFilter::nearest);
  EXPECT_EQ(sampler.min, TextureFilter::nearest_mipmap_linear);
  EXPECT_EQ(sampler.wrap_s, TextureWrap::clamp_to_edge);
  EXPECT_EQ(sampler.wrap_t, TextureWrap::mirrored_repeat);
  EXPECT_EQ(scene.textures[1]->channels(), 3);
  EXPECT_EQ(scene.meshes[0].texcoords, (std::vector<float>{0, 0.5f, 1, 2, 3, -4}));
  const DrawState& plain = std::get<DrawCommand>(scene.frame[0].value).state;
  EXPECT_EQ(plain.texture, nullptr);
  EXPECT_EQ(plain.texture_env, TextureEnv::modulate);
  const DrawState& state = std::get<DrawCommand>(scene.frame[1].value).state;
  EXPECT_EQ(state.texture, scene.textures[1].get());
  EXPECT_EQ(state.texture_env, TextureEnv::blend);
  EXPECT_EQ(state.texture_env_color.g, 2);
  EXPECT_EQ(state.texture_env_color.a, 0.25f);
}

TEST_F(SceneTexture, ReadsFileOncePerAnimation) {
  write("a.ppm", std::string("P6 2 1 255\n") + "abcdef");
  SceneFile file(
      write("s.json",
            R"({"tessera": 1, "textures": {"t": {"file": "a.ppm"}, "u": {"file": "a.ppm", "mag": "nearest"}},
    "light_model": {"ambient": [{"keys": [[0, 0], [1, 1]]}, 0, 0, 1]}})"));
  const Scene first = file.at(0);
  const Scene last = file.at(1);
  EXPECT_EQ(first.textures[0], last.textures[0]);
  EXPECT_EQ(first.textures[1], last.textures[1]);
  EXPECT_NE(first.textures[0], first.textures[1]);
}

// Draws one texel per pixel: rows from the top, components interleaved.
TEST_F(SceneTexture, ReadsTexelsFromScene) {
  SceneFile file(write("s.json",
                       R"({"tessera": 1, "framebuffer": {"width": 3, "height": 2, "alpha": 8},
    "camera": {"view": [1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1],
    "projection": [1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]},
    "textures": {"t": {"channels": 4, "rows": ["00112233445566778899aAbB", "ccddeeff0123456789abcdef"],
    "mag": "nearest"}, "u": {"channels": 4, "rows": ["00112233445566778899aAbB",
    "ccddeeff0123456789abcdef"]}},
    "meshes": {"m": {"primitive": "quads", "positions": [[-1,-1,0],[1,-1,0],[1,1,0],[-1,1,0]],
    "texcoords": [[0,0],[1,0],[1,1],[0,1]]}},
    "light_model": {"ambient": [{"keys": [[0, 0], [1, 1]]}, 0, 0, 1]},
    "frame": [{"draw": "m", "texture": "t", "texture_env": "replace", "lighting": false}]})"));
  const Scene scene = file.at(0);
  FrameBuffer buffer(scene.framebuffer);
  Frame frame(buffer);
  record(scene, frame);
  Renderer().finish(frame);
  EXPECT_EQ(packed_colors(buffer), (std::vector<std::uint32_t>{0x33001122, 0x77445566, 0xbb8899aa, 0xffccddee,
                                                               0x67012345, 0xef89abcd}));
  EXPECT_EQ(file.at(1).textures[0], scene.textures[0]) << "made once";
  EXPECT_NE(scene.textures[0], scene.textures[1]) << "another sampler";
}

TEST_F(SceneTexture, ErrorsNameMissingAndBrokenFiles) {
  EXPECT_THAT(error("none.png"), AllOf(HasSubstr("scene.json: /textures/t/file: cannot read"),
                                       HasSubstr("none.png"), HasSubstr("No such file")));
  write("short.ppm", "P6 4 4 255\nabc");
  EXPECT_THAT(error("short.ppm"), AllOf(HasSubstr("/textures/t/file: cannot read"), HasSubstr("short.ppm"),
                                        HasSubstr("ends before its last pixel")));
  write("zero.ppm", "P6 0 4 255\n");
  EXPECT_THAT(error("zero.ppm"), AllOf(HasSubstr("zero.ppm"), HasSubstr("width, height")));
  write("broken.png", "\x89PNG\r\n\x1a\nnot a picture at all");
  EXPECT_THAT(error("broken.png"),
              AllOf(HasSubstr("/textures/t/file: cannot read"), HasSubstr("broken.png")));
  write("text.png", "hello");
  EXPECT_THAT(error("text.png"), HasSubstr("cannot read"));
  EXPECT_THAT(error("."), HasSubstr("cannot read"));
}

TEST_F(SceneTexture, BuiltInMeshesHaveTextureCoordinates) {
  const Scene scene = parse(
      R"("meshes": {"a": {"builtin": "quad"}, "b": {"builtin": "teapot", "detail": 2},
    "c": {"builtin": "cone", "detail": 3}})");
  EXPECT_EQ(scene.meshes[0].texcoords, (std::vector<float>{0, 0, 1, 0, 0, 1, 1, 1}));
  for (const MeshData& mesh : scene.meshes) EXPECT_EQ(mesh.texcoords.size(), 2 * mesh.vertex_count());
}

}  // namespace
}  // namespace tessera::scene_texture_test
