// Textures on points, lines and outlines: the level of detail along a line, one texel per point, and outlines
// that match the lines they consist of.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>

#include "tests/engine/frame/api_support.h"

namespace tessera::texture_points_lines_test {
namespace {

using namespace test;

constexpr int kSize = 96;
constexpr std::uint32_t kGray = 0x808080;

DrawState replacing(const Texture& texture) {
  DrawState state = unlit({1, 1, 1, 1});
  state.texture = &texture;
  state.texture_env = TextureEnv::replace;
  return state;
}

std::vector<std::uint32_t> drawn(const MeshData& mesh, const DrawState& state, int samples = 1,
                                 int tile_size = 64) {
  FrameBuffer buffer({.width = kSize, .height = kSize, .samples = samples});
  Frame frame(buffer);
  frame.clear({.color = Color{128 / 255.0f, 128 / 255.0f, 128 / 255.0f, 1}, .depth = 1.0});
  frame.draw(mesh.view(), state);
  Renderer({.threads = 1, .tile_size = tile_size}).finish(frame);
  return packed_colors(buffer);
}
std::ptrdiff_t not_gray(const std::vector<std::uint32_t>& words) {
  return std::count_if(words.begin(), words.end(), [](std::uint32_t w) { return (w & 0xffffff) != kGray; });
}

// A line from the window's centre, by its angle in degrees and its texels per pixel of length.
MeshData spoke(double degrees, double length_px, double texels, double texture_width) {
  MeshData mesh;
  mesh.primitive = Primitive::lines;
  const double angle = degrees * 3.141592653589793 / 180;
  const double half = kSize / 2.0;
  for (const double at : {0.0, length_px}) {
    mesh.positions.push_back(static_cast<float>(at * std::cos(angle) / half));
    mesh.positions.push_back(static_cast<float>(at * std::sin(angle) / half));
    mesh.positions.push_back(0);
    mesh.texcoords.push_back(static_cast<float>((at * texels + 0.3) / texture_width));
    mesh.texcoords.push_back(0.5f);
  }
  return mesh;
}

// Black and white columns whose next mipmap level is uniform grey, which shows the level of detail that a
// pixel uses. Equation 3.15 does not depend on the direction; with 3.14, the equation for polygons, diagonals
// would have up to half a level less.
TEST(TexturedLines, UseTheLevelOfDetailAlongTheirLength) {
  std::vector<std::uint8_t> columns(64 * 2);
  for (std::size_t i = 0; i < columns.size(); ++i) columns[i] = i % 2 == 0 ? 0 : 255;
  const Texture texture({.pixels = columns.data(), .width = 64, .height = 2, .channels = 1},
                        {.mag = TextureFilter::nearest, .min = TextureFilter::nearest_mipmap_nearest});
  for (const double degrees : {0.0, 17.0, 45.0, 71.0, 90.0, 135.0, 200.0, 225.0, 270.0, 333.0})
    for (const int samples : {1, 4})
      for (const float width : {1.0f, 5.0f})
        for (const bool blends : {false, true}) {
          const std::string where = std::to_string(degrees) + " degrees, " + std::to_string(samples) +
                                    " samples, width " + std::to_string(width) + ", blends " +
                                    std::to_string(blends);
          DrawState state = replacing(texture);
          state.line_width = width;
          if (blends)
            state.blend = BlendState{.src = BlendFactor::one,
                                     .dst = BlendFactor::one_minus_dst_alpha};  // destination alpha is 1
          EXPECT_EQ(not_gray(drawn(spoke(degrees, 40, std::exp2(0.53), 64), state, samples)), 0) << where;
          const std::ptrdiff_t found =
              not_gray(drawn(spoke(degrees, 40, std::exp2(0.47), 64), state, samples));
          state.texture = nullptr;
          const std::ptrdiff_t covered = not_gray(drawn(spoke(degrees, 40, 1, 64), state, samples));
          EXPECT_GE(covered, 20) << where;
          EXPECT_EQ(found, covered) << where;
        }
}

TEST(TexturedPoints, ShowOneTexelOfTheBaseLevel) {
  Random random(4);
  std::vector<std::uint8_t> pixels(3 * 8 * 8);
  for (std::uint8_t& byte : pixels) byte = static_cast<std::uint8_t>(random.next());
  MeshData mesh;
  mesh.primitive = Primitive::points;
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x) {
      mesh.positions.insert(mesh.positions.end(),
                            {static_cast<float>(x) / 4 - 0.875f, static_cast<float>(y) / 4 - 0.875f, 0});
      mesh.normals.insert(mesh.normals.end(), {0, 0, 1});
      mesh.texcoords.insert(mesh.texcoords.end(),
                            {(static_cast<float>(x) + 0.5f) / 8, (static_cast<float>(y) + 0.5f) / 8});
    }
  for (const TextureFilter mag : {TextureFilter::nearest, TextureFilter::linear})
    for (const Shading shading : {Shading::flat, Shading::gouraud, Shading::phong})
      for (const bool lit : {false, true}) {
        const Texture texture(
            {.pixels = pixels.data(), .width = 8, .height = 8, .channels = 3, .bottom_row_first = true},
            {.mag = mag, .min = TextureFilter::linear_mipmap_linear});
        DrawState state = replacing(texture);
        state.shading = shading;
        state.lighting = lit;
        state.point_size = 10;
        const std::vector<std::uint32_t> words = drawn(mesh, state);
        for (int y = 0; y < kSize; ++y)
          for (int x = 0; x < kSize; ++x) {
            // Each point lies in the middle of 12 pixels and covers 10 of them.
            const bool covered = x % 12 >= 1 && x % 12 <= 10 && y % 12 >= 1 && y % 12 <= 10;
            const std::size_t texel = static_cast<std::size_t>(8 * ((kSize - 1 - y) / 12) + x / 12) * 3;
            const std::uint32_t expected =
                covered ? static_cast<std::uint32_t>(pixels[texel] << 16 | pixels[texel + 1] << 8 |
                                                     pixels[texel + 2])
                        : kGray;
            ASSERT_EQ(words[static_cast<std::size_t>(y * kSize + x)] & 0xffffff, expected)
                << x << " " << y << ", lit " << lit << ", shading " << static_cast<int>(shading);
          }
      }
}

// Largest difference of two packed colours, in levels.
int most_apart(const std::vector<std::uint32_t>& a, const std::vector<std::uint32_t>& b) {
  int largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    for (const int shift : {0, 8, 16})
      largest = std::max(
          largest, std::abs(static_cast<int>(a[i] >> shift & 255) - static_cast<int>(b[i] >> shift & 255)));
  return largest;
}

MeshData colored_lines(Random& random, int count) {
  MeshData mesh;
  mesh.primitive = Primitive::lines;
  for (int i = 0; i < 2 * count; ++i) {
    for (int c = 0; c < 2; ++c)
      mesh.positions.push_back(i % 2 == 0
                                   ? random.between(-1, 1)
                                   : mesh.positions[mesh.positions.size() - 3] + random.between(-0.2f, 0.2f));
    mesh.positions.push_back(0);
    for (int c = 0; c < 4; ++c) mesh.colors.push_back(c == 3 ? 1 : static_cast<float>(random.next() % 2));
    mesh.texcoords.insert(mesh.texcoords.end(), {0.25f, 0.5f});
  }
  return mesh;
}

// Pixels of a line may lie beyond its ends, where colours are extrapolated. They are clamped before texturing
// and before conversion to luminance. A blend without effect selects another pixel path.
TEST(TexturedLines, ClampColorsBeyondTheirEnds) {
  Random random(7);
  const std::uint8_t pixels[] = {128, 90, 60, 200, 255, 255, 255, 255};
  const Texture texture({.pixels = pixels, .width = 2, .height = 1},
                        {.mag = TextureFilter::nearest, .min = TextureFilter::nearest});
  for (int round = 0; round < 24; ++round) {
    const MeshData mesh = colored_lines(random, 30);
    for (const int color_bits : {24, 2}) {
      const auto words_of = [&](bool blends) {
        FrameBuffer buffer({.width = kSize, .height = kSize, .color_bits = color_bits});
        Frame frame(buffer);
        DrawState state = unlit({1, 1, 1, 1});
        state.depth.enabled = false;
        state.line_width = round % 2 == 0 ? 1 : 6;
        if (round % 6 != 5) state.texture = &texture;
        state.texture_env = static_cast<TextureEnv>(round % 5);
        if (blends)
          state.blend = BlendState{.src = BlendFactor::one,
                                   .dst = BlendFactor::one_minus_dst_alpha};  // destination alpha is 1
        frame.draw(mesh.view(), state);
        Renderer({.threads = 1}).finish(frame);
        return packed_colors(buffer);
      };
      EXPECT_LE(most_apart(words_of(false), words_of(true)), color_bits == 24 ? 1 : 0)
          << "round " << round << ", " << color_bits << " bits";
    }
  }
}

// A one-colour texture is folded into the fragment colour; folding before the clamp would give another
// result.
TEST(TexturedLines, FoldOneColorAsTheyShowTexels) {
  Random random(8);
  const std::uint8_t pixels[] = {128, 100, 80, 200, 1, 2, 3, 4};
  const TextureSampler nearest{.mag = TextureFilter::nearest, .min = TextureFilter::nearest};
  const Texture one({.pixels = pixels, .width = 1, .height = 1}, nearest);
  const Texture two({.pixels = pixels, .width = 2, .height = 1}, nearest);
  for (int round = 0; round < 20; ++round)
    for (const int samples : {1, 4}) {
      MeshData mesh = colored_lines(random, 30);
      if (round % 2 == 0) mesh.primitive = Primitive::triangles;
      DrawState state = unlit({1, 1, 1, 1});
      state.line_width = 6;
      state.depth.enabled = false;
      state.texture_env = static_cast<TextureEnv>(round % 5);
      state.texture = &one;
      const std::vector<std::uint32_t> expected = drawn(mesh, state, samples);
      state.texture = &two;
      EXPECT_LE(most_apart(drawn(mesh, state, samples), expected), 1)
          << "round " << round << ", " << samples << " samples";
    }
}

TEST(TexturedOutlines, MatchTexturedLinesAndPoints) {
  Random random(6);
  std::vector<std::uint8_t> pixels(4 * 33 * 17);
  for (std::uint8_t& byte : pixels) byte = static_cast<std::uint8_t>(random.next());
  const Texture texture({.pixels = pixels.data(), .width = 33, .height = 17, .channels = 4});
  for (int round = 0; round < 40; ++round) {
    MeshData mesh;
    mesh.primitive = Primitive::polygon;
    const int corners = 3 + round % 4;
    for (int i = 0; i < corners; ++i) {
      const float angle =
          6.2831853f * (static_cast<float>(i) + random.between(0, 0.8f)) / static_cast<float>(corners);
      mesh.positions.insert(mesh.positions.end(), {0.9f * std::cos(angle), 0.9f * std::sin(angle), 0});
      for (int k = 0; k < 2; ++k) mesh.texcoords.push_back(random.between(-3, 3));
      for (int k = 0; k < 4; ++k) mesh.colors.push_back(k < 3 ? random.between(0, 1) : 1);
    }
    DrawState state = replacing(texture);
    state.texture_env = static_cast<TextureEnv>(round % 5);
    state.alpha_test =
        AlphaTest{.func = Compare::gequal, .ref = 0.25f};  // both use the kernels with fragment operations
    state.line_width = round % 2 == 0 ? 1 : 4;
    state.point_size = 7;
    MeshData others = mesh;
    for (const PolygonMode mode : {PolygonMode::line, PolygonMode::point}) {
      others.primitive = mode == PolygonMode::line ? Primitive::line_loop : Primitive::points;
      const std::vector<std::uint32_t> expected = drawn(others, state, round % 3 == 0 ? 4 : 1);
      DrawState outlined = state;
      outlined.front_mode = outlined.back_mode = mode;
      EXPECT_GE(not_gray(expected), 20);
      EXPECT_EQ(drawn(mesh, outlined, round % 3 == 0 ? 4 : 1, round % 4 == 1 ? 32 : 128), expected)
          << "round " << round << ", mode " << static_cast<int>(mode);
    }
  }
}

}  // namespace
}  // namespace tessera::texture_points_lines_test
