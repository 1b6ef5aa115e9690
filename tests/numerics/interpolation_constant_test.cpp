// An attribute that is equal at all vertices is exactly that value at every pixel: whole and clipped
// triangles, however they are shaded, lit, textured and stored.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "tests/numerics/bounds.h"
#include "tests/numerics/case_renderer.h"
#include "tests/numerics/window_triangle.h"
#include "tests/raster/random_triangles.h"

namespace tessera::test::interpolation_constant_test {
namespace {

constexpr int kSide = 128;

// Whole triangles, and triangles cut by the near plane, the far plane or the guard band; w varies by up to
// 10^6.
std::vector<float> random_positions(Rng& rng) {
  std::vector<float> positions;
  const bool is_whole = rng.maybe();
  const WindowTriangle t = random_triangle(rng, rng.one_of(kWindowShapes), kSide, kSide);
  const double reach = std::pow(10, 6 * rng.unit());
  for (const GridPoint& p : t.at) {
    const double w = std::exp2(20 * rng.unit());
    const auto within = [&](double most) { return most * (2 * rng.unit() - 1); };
    if (is_whole)
      for (const double c : {w * clip_x(p.x, kSide), w * clip_y(p.y, kSide), 0.0, w})
        positions.push_back(static_cast<float>(c));
    else
      for (const double c :
           {within(rng.maybe() ? reach : 2), within(2), within(1.5), 4 * rng.unit() - (rng.maybe() ? 1 : 0)})
        positions.push_back(static_cast<float>(c));
  }
  return positions;
}

float random_constant(Rng& rng) {
  const float c = static_cast<float>(rng.unit());
  // On the border between two levels, or very close to it.
  return rng.maybe() ? c : (std::floor(255 * c) + 0.5f) / 255;
}

TEST(InterpolationConstant, ColorsEqualTheVertexColor) {
  expect_figure("colours, the same at all vertices: off by", 0, "levels",
                [](const MakeRenderer& make, bool is_tessera) {
                  const auto renderer = make({.width = kSide, .height = kSide});
                  Rng rng(51);
                  long double worst = 0;
                  long double visible_pixels = 0;
                  for (int n = 0; n < (is_tessera && long_tests() ? 50000 : 1000); ++n) {
                    CaseDraw draw{.positions = random_positions(rng)};
                    const float c[3] = {random_constant(rng), random_constant(rng), 1};
                    for (int k = 0; k < 3; ++k) draw.colors.insert(draw.colors.end(), {c[0], c[1], c[2], 1});
                    for (const std::array<float, 3>& color : renderer->draw({draw}).colors) {
                      if (color[2] == 0) continue;
                      ++visible_pixels;
                      for (std::size_t k = 0; k < 3; ++k) {
                        // Mesa's colours are not rounded to levels.
                        const float expected =
                            is_tessera ? std::floor(std::fma(c[k], 255.0f, 0.5f)) / 255.0f : c[k];
                        update_worst(worst, 255 * std::abs(static_cast<long double>(color[k]) - expected));
                      }
                    }
                  }
                  EXPECT_GT(visible_pixels, 1e5);
                  return worst;
                });
}

// Edges run through pixel centres, where the vertex with the largest 1/w may have weight 0. The pixel is
// white for any ratio.
TEST(InterpolationConstant, WhiteStaysWhiteForAnyRatioOfW) {
  expect_figure("white triangles, w apart by up to 2^170: pixels that are not white", 0, "pixels",
                [](const MakeRenderer& make, bool) {
                  const auto renderer = make({.width = kSide, .height = kSide});
                  Rng rng(57);
                  long double wrong = 0;
                  long double visible_pixels = 0;
                  constexpr double kRatios[] = {20, 40, 63, 64, 65, 80, 120, 135, 170};
                  const auto center = [&] {
                    return static_cast<std::int64_t>(kSide * rng.unit()) * kGrid + kGrid / 2;
                  };
                  for (int n = 0; n < 400; ++n) {
                    const double ratio = rng.one_of(kRatios);
                    const int heavy = static_cast<int>(3 * rng.unit());
                    const int second = rng.maybe() ? (heavy + 1) % 3 : heavy;
                    CaseDraw with_ratio;
                    CaseDraw without;
                    for (int k = 0; k < 3; ++k) {
                      const double x = clip_x(center(), kSide);
                      const double y = clip_y(center(), kSide);
                      const double w = std::exp2(k == heavy || k == second ? -60 : ratio - 60);
                      for (const double c : {w * x, w * y, 0.0, w})
                        with_ratio.positions.push_back(static_cast<float>(c));
                      for (const double c : {x, y, 0.0, 1.0})
                        without.positions.push_back(static_cast<float>(c));
                      for (CaseDraw* draw : {&with_ratio, &without})
                        draw->colors.insert(draw->colors.end(), {1, 1, 1, 1});
                    }
                    const auto expected = renderer->draw({without}).colors;
                    const auto found = renderer->draw({with_ratio}).colors;
                    for (std::size_t i = 0; i < expected.size(); ++i) {
                      visible_pixels += expected[i][0];
                      wrong += expected[i] == found[i] ? 0 : 1;
                    }
                  }
                  EXPECT_GT(visible_pixels, 1e5);
                  return wrong;
                });
}

// Between two texels, where the smallest change would show.
TEST(InterpolationConstant, TextureCoordinatesGiveOneColor) {
  for (const bool nearest : {false, true})
    expect_figure(std::string("texture coordinates, the same at all vertices") +
                      (nearest ? ", nearest" : ", linear") + ": colours apart",
                  0, "levels", [nearest](const MakeRenderer& make, bool is_tessera) {
                    const auto renderer = make({.width = kSide,
                                                .height = kSide,
                                                .texture_width = 2,
                                                .texture_height = 2,
                                                .texture = {32, 255, 255, 32},
                                                .nearest_texel = nearest});
                    Rng rng(52);
                    long double worst = 0;
                    long visible_pixels = 0;
                    for (int n = 0; n < (is_tessera && long_tests() ? 50000 : 1000); ++n) {
                      CaseDraw draw{.positions = random_positions(rng), .textured = true};
                      const float s = rng.maybe() ? 0.5f : random_constant(rng);
                      const float t = rng.maybe() ? 0.5f : random_constant(rng);
                      for (int k = 0; k < 3; ++k) draw.texcoords.insert(draw.texcoords.end(), {s, t});
                      float low = 2, high = 0;
                      for (const std::array<float, 3>& color : renderer->draw({draw}).colors)
                        if (color[0] > 0) {
                          low = std::min(low, color[0]);
                          high = std::max(high, color[0]);
                          ++visible_pixels;
                        }
                      if (high > 0) update_worst(worst, 255 * (static_cast<long double>(high) - low));
                    }
                    EXPECT_GT(visible_pixels, 100000);
                    return worst;
                  });
}

struct ShadingPath {
  const char* name;
  void (*change)(DrawState& state, const Texture& texture);
};
constexpr ShadingPath kShadingPaths[] = {
    {"plain", [](DrawState&, const Texture&) {}},
    {"textured", [](DrawState& s, const Texture& t) { s.texture = &t; }},
    {"blended", [](DrawState& s, const Texture&) { s.blend = BlendState{}; }},
    {"tested",
     [](DrawState& s, const Texture&) {
       s.alpha_test = AlphaTest{.func = Compare::equal, .ref = 0.7f};
       s.stencil = StencilState{.front = {.zpass = StencilOp::incr}};
     }},
    {"two lights' colours", [](DrawState& s, const Texture&) { s.color_material = ColorMaterial::diffuse; }},
};

// On every pixel path, on each instruction set, with one and several samples: one packed color wherever a
// triangle covers the whole pixel. Distant lights and a single normal make lit points equal, too. The alpha
// test passes only the exact vertex alpha.
TEST(InterpolationConstant, EveryPixelPathGivesOneColor) {
  const std::uint8_t texels[4] = {32, 255, 255, 32};
  const Texture texture({.pixels = texels, .width = 2, .height = 2, .channels = 1});
  Rng rng(53);
  std::size_t visible_pixels = 0;
  for (const InstructionSet set : available_instruction_sets())
    for (const bool defers : {true, false})
      for (const int samples : {1, 4}) {
        Renderer renderer({.threads = 1, .instruction_set = set, .debug = {.defer_shading = defers}});
        FrameBuffer buffer({.width = kSide, .height = kSide, .samples = samples});
        std::vector<std::uint32_t> words(kSide * kSide);
        std::vector<std::uint32_t> covered(kSide * kSide);
        for (int n = 0; n < (long_tests() ? 500 : 15); ++n) {
          const std::vector<float> positions = random_positions(rng);
          std::vector<float> colors;
          std::vector<float> normals;
          std::vector<float> texcoords;
          const float r = random_constant(rng);
          const float g = random_constant(rng);
          const float s = rng.maybe() ? 0.5f : random_constant(rng);
          const float x = static_cast<float>(rng.unit() - 0.5);
          const float y = static_cast<float>(rng.unit() - 0.5);
          const float z = static_cast<float>(rng.unit());
          for (int k = 0; k < 3; ++k) {
            colors.insert(colors.end(), {r, g, 0.9f, 0.7f});
            normals.insert(normals.end(), {x, y, z});
            texcoords.insert(texcoords.end(), {s, 0.5f});
          }
          const Mesh mesh{.positions = positions,
                          .position_components = 4,
                          .normals = normals,
                          .colors = colors,
                          .texcoords = texcoords};
          const auto draw = [&](const DrawState& state, std::vector<std::uint32_t>& to) {
            Frame frame(buffer);
            frame.set_lights({Light{.position = {0.3f, 0.2f, 1, 0}},
                              Light{.diffuse = {0.2f, 0.3f, 0.1f, 1}, .position = {-0.5f, 0.4f, 0.3f, 0}}});
            frame.clear({.color = Color{0, 0, 0, 1}, .depth = 1.0, .stencil = 0});
            frame.draw(mesh, state);
            renderer.finish(frame);
            buffer.read_packed_colors(to);
          };
          DrawState white;
          white.lighting = false;
          white.material.diffuse = {1, 1, 1, 1};
          const Mesh plain{.positions = positions, .position_components = 4};
          Frame frame(buffer);
          frame.clear({.color = Color{0, 0, 0, 1}, .depth = 1.0});
          frame.draw(plain, white);
          renderer.finish(frame);
          buffer.read_packed_colors(covered);
          for (const Shading shading : {Shading::flat, Shading::gouraud, Shading::phong})
            for (const bool lit : {false, true})
              for (const ShadingPath& path : kShadingPaths) {
                DrawState state;
                state.shading = shading;
                state.lighting = lit;
                state.color_material = ColorMaterial::ambient_and_diffuse;
                state.material.emission = {0, 0, 0.5f, 1};  // never black
                state.material.specular = {0.3f, 0.3f, 0.3f, 1};
                state.material.shininess = 10;
                path.change(state, texture);
                draw(state, words);
                std::optional<std::uint32_t> word;
                for (std::size_t i = 0; i < words.size(); ++i) {
                  if (covered[i] != 0xffffff) continue;
                  if (!word) word = words[i];
                  ASSERT_EQ(words[i], *word)
                      << path.name << (lit ? ", lit, " : ", ") << static_cast<int>(shading) << ", "
                      << name(set) << ", " << samples << " samples, pixel " << i;
                  ASSERT_NE(words[i], 0u);
                  ++visible_pixels;
                }
              }
        }
      }
  EXPECT_GT(visible_pixels, 100000u);
}

}  // namespace
}  // namespace tessera::test::interpolation_constant_test
