// The depth of a triangle depends on nothing but the triangle. Drawn again, it equals itself at every pixel,
// within any mesh, however it is clipped, coloured or tested, on each instruction set, at every tile size and
// sample count. No tolerance.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "tests/numerics/bounds.h"
#include "tests/numerics/case_renderer.h"
#include "tests/numerics/depth_formats.h"
#include "tests/numerics/window_triangle.h"
#include "tests/raster/random_triangles.h"

namespace tessera::test::depth_equal_test {
namespace {

constexpr int kSide = 128;

// Whole triangles, and triangles cut by the near plane, the far plane or the guard band. Four vertices each:
// a quad.
std::vector<float> random_corners(Rng& rng) {
  std::vector<float> positions;
  const auto add = [&](double x, double y, double z, double w) {
    for (const double c : {x, y, z, w}) positions.push_back(static_cast<float>(c));
  };
  const auto within = [&](double reach) { return reach * (2 * rng.unit() - 1); };
  if (rng.maybe()) {
    const WindowTriangle t = random_triangle(rng, rng.one_of(kWindowShapes), kSide, kSide);
    for (const GridPoint& p : t.at) add(clip_x(p.x, kSide), clip_y(p.y, kSide), within(1), 1);
    add(within(1), within(1), within(1), 1);
  } else {
    const double reach = std::pow(10, 6 * rng.unit());
    for (int k = 0; k < 4; ++k) {
      const double w = rng.unit() * 4 - (rng.maybe() ? 1 : 0);
      add(within(rng.maybe() ? reach : 2), within(2), within(1.5), w);
    }
  }
  return positions;
}

struct Twice {
  CaseDraw first;
  CaseDraw again;
};

Twice two_triangles(Rng& rng) {
  Twice twice{.first = {.positions = random_corners(rng),
                        .indices = {0, 1, 2, 0, 2, 3},
                        .color = {1, 0, 0, 1},
                        .test_depth = true},
              .again = {}};
  twice.again = twice.first;
  twice.again.color = {0, 1, 0, 1};
  twice.again.depth_func = Compare::equal;
  return twice;
}

// Embeds the draw in a larger mesh at different indices. The added triangles are invisible.
CaseDraw larger_mesh(Rng& rng, CaseDraw draw) {
  const std::vector<float> original = draw.positions;
  const std::vector<float> more = random_corners(rng);
  draw.positions.clear();
  draw.indices.clear();
  for (int n = 0; n < 40; ++n) {
    if (n == 23) draw.positions.insert(draw.positions.end(), original.begin(), original.end());
    for (std::size_t i = 0; i < more.size(); ++i)
      draw.positions.push_back(i % 4 == 0 ? more[i] + 3 * std::abs(more[i + 3]) + 3e7f : more[i]);
  }
  for (std::uint32_t n = 0; n < 41; ++n)
    for (const std::uint32_t k : {0, 1, 2, 0, 2, 3}) draw.indices.push_back(4 * n + k);
  return draw;
}

// Triangles all over the window, behind the existing surface.
CaseDraw others(Rng& rng) {
  CaseDraw draw{.color = {0, 0, 1, 1}, .test_depth = true, .depth_near = 1, .depth_far = 1};
  for (int n = 0; n < 20; ++n) {
    const std::vector<float> corners = random_corners(rng);
    draw.positions.insert(draw.positions.end(), corners.begin(), corners.begin() + 12);
  }
  return draw;
}

struct Pixels {
  long double wrong = 0;
  long double visible = 0;
};
void add_pixels(Pixels& pixels, const CasePicture& picture) {
  for (const std::array<float, 3>& color : picture.colors) {
    pixels.wrong += color[0] > 0;
    pixels.visible += color[1] > 0;
  }
}

TEST(DepthEqual, TheSameTriangleAgainIsEqualEverywhere) {
  for (const DepthCase& depth : kDepthCases)
    expect_figure("depth, " + std::string(depth.name) + ", the same triangle again", 0, "pixels",
                  [&](const MakeRenderer& make, bool is_tessera) {
                    const auto renderer = make({.width = kSide, .height = kSide, .depth = depth.format});
                    Rng rng(31);
                    Pixels pixels;
                    for (int n = 0; n < (is_tessera && long_tests() ? 10000 : 300); ++n) {
                      const Twice twice = two_triangles(rng);
                      for (const CaseDraw& again : {twice.again, larger_mesh(rng, twice.again)})
                        add_pixels(pixels, renderer->draw({twice.first, others(rng), again}));
                    }
                    EXPECT_GT(pixels.visible, 1e5);
                    return pixels.wrong;
                  });
}

// Not compared with Mesa, which splits quads and polygons differently.
TEST(DepthEqual, TheSameTriangleIsEqualInOtherPrimitives) {
  for (const DepthCase& depth : kDepthCases) {
    const auto renderer = make_tessera({.width = kSide, .height = kSide, .depth = depth.format});
    Rng rng(33);
    Pixels pixels;
    for (int n = 0; n < (long_tests() ? 10000 : 100); ++n)
      for (const Primitive primitive : {Primitive::triangle_fan, Primitive::polygon, Primitive::quads})
        for (const bool first : {false, true}) {
          Twice twice = two_triangles(rng);
          CaseDraw& other = first ? twice.first : twice.again;
          other.primitive = primitive;
          other.indices.clear();
          add_pixels(pixels, renderer->draw({twice.first, others(rng), twice.again}));
        }
    EXPECT_GT(pixels.visible, 1e5);
    expect_within(
        "depth, " + std::string(depth.name) + ", the same triangle again, of a fan, a polygon, quads",
        pixels.wrong, 0, "pixels");
  }
}

// States that select another path through the engine. The colours do not matter.
struct ShadingPath {
  const char* name;
  void (*change)(DrawState& state, const Texture& texture);
};
constexpr ShadingPath kShadingPaths[] = {
    {"plain", [](DrawState&, const Texture&) {}},
    {"depth alone",
     [](DrawState& s, const Texture&) {
       s.color_mask = {false, false, false, false};
     }},
    {"flat", [](DrawState& s, const Texture&) { s.shading = Shading::flat, s.lighting = true; }},
    {"gouraud", [](DrawState& s, const Texture&) { s.lighting = true; }},
    {"phong", [](DrawState& s, const Texture&) { s.shading = Shading::phong, s.lighting = true; }},
    {"blended", [](DrawState& s, const Texture&) { s.blend = BlendState{}, s.material.diffuse.a = 0.5f; }},
    {"textured", [](DrawState& s, const Texture& t) { s.texture = &t; }},
    {"textured and blended",
     [](DrawState& s, const Texture& t) {
       s.texture = &t;
       s.blend = BlendState{};
       s.material.diffuse.a = 0.5f;
     }},
    {"stencil",
     [](DrawState& s, const Texture&) { s.stencil = StencilState{.front = {.zpass = StencilOp::incr}}; }},
    {"alpha tested", [](DrawState& s, const Texture&) { s.alpha_test = AlphaTest{.ref = 0.25f}; }},
    {"masked", [](DrawState& s, const Texture&) { s.plane_mask = 0x00ffff; }},
    {"logic", [](DrawState& s, const Texture&) { s.logic_op = LogicOp::bit_xor; }},
    {"cut",
     [](DrawState& s, const Texture&) {
       s.scissor = Rect{0, 0, kSide, kSide};
     }},
    {"no offset",
     [](DrawState& s, const Texture&) {
       s.polygon_offset = {0, 1e-30f};
     }},
};

// Draws in rectangles that tile the window, so that clipping differs and small and large triangles take
// different paths.
void draw_in_parts(Frame& frame, const Mesh& mesh, DrawState state, int step) {
  for (int y = 0; y < kSide; y += step)
    for (int x = 0; x < kSide; x += step) {
      state.scissor = Rect{x, y, step, step};
      frame.draw(mesh, state);
    }
}

TEST(DepthEqual, TheSameTriangleIsEqualOnEveryPath) {
  const std::uint8_t texels[4] = {40, 255, 130, 90};
  const Texture texture({.pixels = texels, .width = 2, .height = 2, .channels = 1});
  Rng rng(32);
  std::size_t compared = 0;
  for (const DepthCase& depth : kDepthCases)
    for (const int samples : {1, 4, 8}) {
      FrameBuffer buffer({.width = kSide, .height = kSide, .depth = depth.format, .samples = samples});
      for (int round = 0; round < (long_tests() ? 40 : 1); ++round) {
        std::vector<float> positions;
        std::vector<float> texcoords;
        for (int n = 0; n < 12; ++n) {
          const std::vector<float> corners = random_corners(rng);
          positions.insert(positions.end(), corners.begin(), corners.begin() + 12);
          texcoords.insert(texcoords.end(), {0, 0, 1, 0, 0, 1});
        }
        const Mesh mesh{.positions = positions, .position_components = 4, .texcoords = texcoords};
        std::optional<std::vector<std::uint32_t>> expected;
        for (const InstructionSet set : available_instruction_sets())
          for (const int tile_size : {32, 64, 128}) {
            Renderer renderer({.threads = 1, .tile_size = tile_size, .instruction_set = set});
            DrawState last;
            last.lighting = false;
            last.material.diffuse = {0, 1, 0, 1};
            const auto words_of = [&](const auto& first) {
              Frame frame(buffer);
              frame.clear({.color = Color{0, 0, 0, 1}, .depth = 1.0, .stencil = 0});
              first(frame);
              // Only fragments of equal depth reach the colour buffer.
              frame.clear({.color = Color{0, 0, 0, 1}});
              DrawState again = last;
              again.depth.test = Compare::equal;
              frame.draw(mesh, again);
              renderer.finish(frame);
              std::vector<std::uint32_t> words(kSide * kSide);
              buffer.read_packed_colors(words);
              return words;
            };
            if (!expected) {  // covered pixels, without a depth test
              Frame frame(buffer);
              frame.clear({.color = Color{0, 0, 0, 1}});
              DrawState plain = last;
              plain.depth.enabled = false;
              frame.draw(mesh, plain);
              renderer.finish(frame);
              expected.emplace(kSide * kSide);
              buffer.read_packed_colors(*expected);
              compared += static_cast<std::size_t>(std::count_if(
                  expected->begin(), expected->end(), [](std::uint32_t word) { return word != 0; }));
            }
            const auto where = [&](const std::string& path) {
              return path + ", " + depth.name + ", " + std::to_string(samples) + " samples, " +
                     std::string(name(set)) + ", tiles of " + std::to_string(tile_size);
            };
            for (const ShadingPath& path : kShadingPaths) {
              const auto words = words_of([&](Frame& frame) {
                DrawState state = last;
                path.change(state, texture);
                frame.draw(mesh, state);
              });
              ASSERT_TRUE(words == *expected) << where(path.name);
            }
            for (const int step : {4, 13, 64})
              ASSERT_TRUE(words_of([&](Frame& frame) { draw_in_parts(frame, mesh, last, step); }) ==
                          *expected)
                  << where("in parts of " + std::to_string(step));
          }
      }
    }
  EXPECT_GT(compared, 10000u);
}

}  // namespace
}  // namespace tessera::test::depth_equal_test
