// With several samples a pixel's centre may lie outside of the triangle that its samples see, of a sliver by many times its width: what is shaded there
// stays within the range of the vertices all the same. The mean of samples that are within a range, and of a clear that is, is within it too.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include "tests/engine/api_support.h"
#include "tests/numerics/bounds.h"
#include "tests/raster/random_triangles.h"

namespace tessera::test {
namespace {

constexpr int kSide = 64, kLow = 102, kHigh = 153;  // of 255

// Triangles of any shape, half of them slivers, under perspective. Colours, and texels that are their coordinates, from kLow to kHigh.
MeshData any_triangles(Random& random) {
  MeshData mesh;
  mesh.position_components = 4;
  for (int i = 0; i < 40; ++i) {
    const float thin = i % 2 == 0 ? 0.02f : 1;
    const float x = random.between(-1, 1), y = random.between(-1, 1);
    for (int k = 0; k < 3; ++k) {
      const float w = i % 3 == 0 ? 1 : random.between(0.1f, 4);
      const float value = (kLow + static_cast<float>(random.next() % (kHigh - kLow + 1))) / 255;
      for (const float c : {(x + thin * random.between(-1, 1)) * w, (y + random.between(-1, 1)) * w, 0.0f, w}) mesh.positions.push_back(c);
      for (const float c : {value, value, value, 1.0f}) mesh.colors.push_back(c);
      mesh.texcoords.insert(mesh.texcoords.end(), {(value * 255 + 0.5f) / 256, 0.5f});
    }
  }
  return mesh;
}

void expect_range(const std::string& what, bool textured, const std::function<void(DrawState&)>& set_up, Dither dither = Dither::none) {
  std::vector<std::uint8_t> texels(256);
  for (std::size_t i = 0; i < texels.size(); ++i) texels[i] = static_cast<std::uint8_t>(i);
  const Texture nearest({.pixels = texels.data(), .width = 256, .height = 1, .channels = 1}, {.mag = TextureFilter::nearest, .min = TextureFilter::nearest});
  int worst = 0;
  std::size_t seen = 0;
  for (const int samples : {1, 4, 8})
    for (const bool defer : {false, true}) {
      Random random(7);
      Renderer renderer({.threads = 1, .defer_shading = defer});
      for (int n = 0; n < (long_tests() ? 2000 : 40); ++n) {
        FrameBuffer buffer({.width = kSide, .height = kSide, .dither = dither, .samples = samples});
        Frame frame(buffer);
        constexpr float kBetween = 127 / 255.0f;
        frame.clear({.color = Color{kBetween, kBetween, kBetween, 1}, .depth = 1.0});
        DrawState state;
        state.lighting = false;
        if (textured) state.texture = &nearest;
        state.texture_env = TextureEnv::replace;
        set_up(state);
        const MeshData mesh = any_triangles(random);
        frame.draw(mesh.view(), state);
        renderer.finish(frame);
        for (const std::uint32_t word : color_words(buffer))
          for (const int shift : {0, 8, 16}) {
            const int level = static_cast<int>(word >> shift & 255);
            worst = std::max({worst, kLow - level, level - kHigh});
            seen += level != 127 ? 1 : 0;
          }
      }
    }
  EXPECT_GT(seen, 1000u);
  expect_within("1, 4 and 8 samples, " + what + ": beyond the vertices' own", worst, 0, "levels");
}

TEST(SampledRange, OfColors) {
  expect_range("colours", false, [](DrawState&) {});
  expect_range("colours that are blended", false, [](DrawState& s) { s.blend = BlendState{.src = BlendFactor::one, .dst = BlendFactor::one_minus_src_alpha}; });
  expect_range("colours under an alpha test", false, [](DrawState& s) { s.alpha_test = AlphaTest{.func = Compare::gequal, .ref = 0}; });
}
TEST(SampledRange, OfTexels) {
  expect_range("nearest texels", true, [](DrawState&) {});
  expect_range("nearest texels under an alpha test", true, [](DrawState& s) { s.alpha_test = AlphaTest{.func = Compare::gequal, .ref = 0}; });
}

}  // namespace
}  // namespace tessera::test
