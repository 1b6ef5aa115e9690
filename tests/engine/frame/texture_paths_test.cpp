// Textured triangles with immediate shading have a specialized pixel path. A stencil test that every fragment
// passes selects the path with fragment operations: both give the same pixels and the same number of shaded
// pixels.
#include <gtest/gtest.h>

#include <string>

#include "tests/engine/frame/api_support.h"

namespace tessera::texture_paths_test {
namespace {

using namespace test;

constexpr int kWidth = 200, kHeight = 140;

// Some larger than the picture, some clipped, some back-facing.
MeshData triangles(Random& random) {
  MeshData mesh;
  mesh.position_components = 4;
  for (int i = 0; i < 24; ++i) {
    const float size = i % 3 == 0 ? 3.0f : 0.6f;
    const float x = random.between(-1, 1), y = random.between(-1, 1);
    for (int k = 0; k < 3; ++k) {
      const float w = i % 2 == 0 ? 1.0f : random.between(0.3f, 3);
      mesh.positions.insert(mesh.positions.end(),
                            {w * (x + random.between(-size, size)), w * (y + random.between(-size, size)),
                             w * random.between(-0.9f, 0.9f), w});
      for (int c = 0; c < 4; ++c) mesh.colors.push_back(random.between(0, 1));
      for (int c = 0; c < 2; ++c) mesh.texcoords.push_back(random.between(-3, 3));
    }
  }
  return mesh;
}

struct Result {
  std::vector<std::uint32_t> words;
  std::uint64_t shaded;
};
Result drawn(const MeshData& mesh, DrawState state, InstructionSet set, bool with_operations,
             const FrameBufferFormat& config) {
  // Every fragment passes: the whole stencil buffer is 0.
  if (with_operations) state.stencil = StencilState{.front = {.func = Compare::equal}};
  FrameBuffer buffer(config);
  Frame frame(buffer);
  frame.clear({.color = Color{0.2f, 0.4f, 0.6f, 1}, .depth = 0.8, .stencil = 0u});
  frame.draw(mesh.view(), state);
  const FrameStats stats =
      Renderer({.threads = 1, .instruction_set = set, .debug = {.defer_shading = false}}).finish(frame);
  return {packed_colors(buffer), stats.shaded_pixels};
}

TEST(TexturePaths, ImmediatePathMatchesThePathWithOperations) {
  Random random(31);
  std::vector<std::uint8_t> pixels(4 * 32 * 16);
  for (std::uint8_t& byte : pixels) byte = static_cast<std::uint8_t>(random.next());
  constexpr TextureFilter kMins[] = {
      TextureFilter::nearest, TextureFilter::linear, TextureFilter::linear_mipmap_linear,
      TextureFilter::linear_mipmap_nearest, TextureFilter::nearest_mipmap_linear};
  std::uint64_t shaded = 0;
  for (int round = 0; round < 240; ++round) {
    const MeshData mesh = triangles(random);
    const TextureFilter min = kMins[round % 5];
    const Texture texture(
        {.pixels = pixels.data(), .width = 32, .height = round % 7 == 0 ? 1 : 16, .channels = 3 + round % 2},
        {.mag = min == TextureFilter::nearest ? TextureFilter::nearest : TextureFilter::linear,
         .min = min,
         .wrap_s = static_cast<TextureWrap>(round / 5 % 3),
         .wrap_t = static_cast<TextureWrap>(round / 15 % 3)});
    DrawState state = unlit({0.9f, 0.7f, 0.5f, 1});
    state.texture = &texture;
    state.texture_env =
        round % 10 == 0
            ? TextureEnv::replace
            : static_cast<TextureEnv>(random.next() % 5);  // nearest texels have separate row kernels
    state.texture_env_color = {0.3f, 0.9f, 0.1f, 1};
    state.depth = {.enabled = round % 2 == 1, .write = round % 4 == 1};
    if (round % 3 == 1) state.scissor = Rect{.x = 0, .y = 0, .width = 128, .height = 64};
    if (round % 3 == 2) state.scissor = Rect{.x = 13, .y = 7, .width = 101, .height = 95};
    if (round % 8 == 4) state.plane_mask = 0x0ff33fu;
    FrameBufferFormat config{.width = round % 20 == 9 || round % 60 == 0 ? 2100 : kWidth, .height = kHeight};
    if (round % 10 == 7) config.color_bits = 15;
    const Result expected = drawn(mesh, state, InstructionSet::scalar, true, config);
    for (const InstructionSet set : available_instruction_sets()) {
      const std::string where = "round " + std::to_string(round) + ", " + std::string(name(set));
      const Result at_once = drawn(mesh, state, set, false, config);
      ASSERT_EQ(at_once.words, expected.words) << where;
      ASSERT_EQ(at_once.shaded, expected.shaded) << where;
    }
    shaded += expected.shaded;
  }
  EXPECT_GT(shaded, 240u * kWidth * kHeight);
}

}  // namespace
}  // namespace tessera::texture_paths_test
