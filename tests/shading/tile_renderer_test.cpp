// A pixel's colour does not depend on its path: immediate or deferred shading, the path of small or of large
// triangles, alone or among others, on every instruction set.
#include "shading/tile_renderer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "shading/interpolate_reference.h"
#include "shading/tile_workspace.h"
#include "tests/raster/depth_cases.h"
#include "tests/raster/random_triangles.h"
#include "tests/raster/tile_harness.h"
#include "tests/shading/lighting_cases.h"

namespace tessera::test::tile_renderer_test {
using namespace detail;
namespace {

constexpr int kTile = 64;

// Triangles with depth, 1/w and attributes.
struct Mesh {
  std::vector<WindowVertex> vertices;
  std::vector<float> attributes;
  std::vector<std::uint32_t> visible;  // triangles with an area
  int stride = 3;                      // floats per vertex
};

bool is_clockwise(const Triangle& v) {  // y goes down
  const auto from_first = [&](std::size_t k) {
    return std::pair{Exact{v[k].x} - v[0].x, Exact{v[k].y} - v[0].y};
  };
  const auto [ax, ay] = from_first(1);
  const auto [bx, by] = from_first(2);
  return ax * by - ay * bx > 0;
}

enum class Sides { both, one };  // visible sides of the triangles
/// @param low, high  range of the attributes
Mesh random_mesh(RandomTriangles& source, int triangles, int stride, DepthFormat kind, double low,
                 double high, Sides sides = Sides::both) {
  Mesh mesh;
  mesh.stride = stride;
  for (int i = 0; i < triangles; ++i) {
    DepthTriangle t = with_random_depths(source, source.next());
    if (sides == Sides::one && is_clockwise(t.corners)) std::swap(t.corners[1], t.corners[2]);
    set_words(t, kind);
    const bool flat = source.between(0, 2) == 0;
    for (WindowVertex v : t.corners) {
      v.rw = flat ? 0.5f : static_cast<float>(std::exp2(20 * source.unit() - 10));
      mesh.vertices.push_back(v);
    }
    if (reference_of(t.corners).area != 0) mesh.visible.push_back(static_cast<std::uint32_t>(i));
  }
  mesh.attributes.resize(mesh.vertices.size() * static_cast<std::size_t>(stride) + kAttributePadding);
  for (float& a : mesh.attributes) a = static_cast<float>(low + (high - low) * source.unit());
  return mesh;
}
TileDraw& add(TileHarness& stage, const Mesh& mesh, std::span<const std::uint32_t> triangles) {
  TileDraw& draw = stage.add_draw(mesh.vertices.data());
  draw.source = ColorSource::interpolated;
  draw.attributes = mesh.attributes.data();
  draw.attribute_stride = draw.attribute_count = mesh.stride;
  for (const std::uint32_t id : triangles) stage.push(0, stage.draw_count() - 1, id);
  return draw;
}
TileDraw& add(TileHarness& stage, const Mesh& mesh) { return add(stage, mesh, mesh.visible); }

TEST(TileRenderer, InterpolatedColorsMatchTheScalarTwin) {
  for (const int bits : {3, 8, 16, 24}) {
    RandomTriangles source(static_cast<std::uint32_t>(41 + bits), kTile);
    TileHarness stage(kTile, kTile, kTile);
    stage.frame().layout = rgb_layout(bits);
    const ColorLayout layout = stage.frame().layout;
    for (int round = 0; round < 100; ++round) {
      stage.clear_draws();
      Mesh mesh = random_mesh(source, 1, 3, DepthFormat::none, 0, 1);
      const float levels[3] = {static_cast<float>((1 << layout.r_bits) - 1),
                               static_cast<float>((1 << layout.g_bits) - 1),
                               static_cast<float>((1 << layout.b_bits) - 1)};
      for (std::size_t i = 0; i < 9; ++i) mesh.attributes[i] = mesh.attributes[i] * levels[i % 3] + 0.5f;
      if (mesh.visible.empty()) continue;
      add(stage, mesh);
      const WindowVertex v[3] = {mesh.vertices[0], mesh.vertices[1], mesh.vertices[2]};
      for (const InstructionSet isa : available_isas()) {
        stage.render(isa, 0, 0xffffffffu);
        TriangleReference(v).for_each_covered(0, 0, kTile, kTile, [&](int x, int y) {
          const BarycentricReference at = barycentric_reference(v, x, y);
          const float* a = mesh.attributes.data();
          const auto level = [&](int c) {
            return static_cast<std::uint32_t>(at.interpolate(a[c], a[3 + c], a[6 + c]));
          };
          ASSERT_EQ(stage.color(x, y), level(0) << layout.r_shift() | level(1) << layout.g_shift() | level(2))
              << name_of(isa) << " " << bits << " bits";
        });
      }
    }
  }
}

std::int32_t farthest_key(DepthFormat kind) {
  switch (kind) {
    case DepthFormat::float32: return depth_key_from_stored(kind, 0x3f800000u);
    case DepthFormat::none: return depth_key_from_stored(kind, 0xffffffu);
    default: return depth_key_from_stored(kind, 0xffffffffu >> (32 - depth_bits(kind)));
  }
}

TEST(TileRenderer, ImmediateAndDeferredShadingAgree) {
  for (const DepthFormat kind : {DepthFormat::none, DepthFormat::unorm16, DepthFormat::unorm24,
                                 DepthFormat::unorm32, DepthFormat::float32}) {
    RandomTriangles source(42, kTile);
    TileHarness stage(kTile, kTile, kTile, kind);
    for (int round = 0; round < (long_tests() ? 1000 : 60); ++round) {
      const Mesh mesh = random_mesh(source, 1 + source.between(0, 60), 3, kind, 0.5, 255.5,
                                    round % 2 == 0 ? Sides::both : Sides::one);
      for (const InstructionSet isa : available_isas()) {
        std::vector<std::uint32_t> colors[3];
        std::vector<std::int32_t> depths[3];
        for (int mode = 0; mode < 3; ++mode) {  // immediate, deferred, deferred triangle by triangle
          stage.clear_draws();
          TileDraw& draw = add(stage, mesh);
          draw.uses_depth = kind != DepthFormat::none;
          draw.deferred = mode != 0;
          stage.frame().shade_immediately = mode == 2;
          stage.render(isa, 0, 0x123456, farthest_key(kind));
          colors[mode] = stage.colors();
          depths[mode] = stage.depths();
        }
        ASSERT_EQ(colors[1], colors[0]) << name_of(isa) << ": deferred";
        ASSERT_EQ(colors[2], colors[0]) << name_of(isa) << ": deferred triangle by triangle";
        if (kind != DepthFormat::none) {
          ASSERT_EQ(depths[1], depths[0]);
        }
      }
    }
  }
}

// Draws may have one colour per side; the sides of other triangles in a group must not matter.
TEST(TileRenderer, TrianglesHaveTheColorsOfTheirVisibleSide) {
  RandomTriangles source(49, kTile);
  TileHarness stage(kTile, kTile, kTile);
  for (int round = 0; round < (long_tests() ? 1000 : 60); ++round) {
    const Mesh mesh = random_mesh(source, 1 + source.between(0, 60), 6, DepthFormat::none, 0.5, 255.5);
    // Facing of the polygons that the triangles were cut from.
    std::vector<Facing> facing(mesh.vertices.size() / 3);
    for (Facing& side : facing) side = source.between(0, 1) == 0 ? Facing::front : Facing::back;
    const bool of_polygons = round % 3 == 0;
    const bool front_is_clockwise = round % 2 == 0;
    const bool deferred = round % 4 < 2;
    const auto shows_back = [&](std::uint32_t id) {
      if (of_polygons) return facing[id] == Facing::back;
      const WindowVertex* const corners = mesh.vertices.data() + 3 * std::size_t{id};
      return is_clockwise({corners[0], corners[1], corners[2]}) != front_is_clockwise;
    };
    for (const InstructionSet isa : available_isas()) {
      stage.clear_draws();
      TileDraw& draw = add(stage, mesh);
      draw.color_attribute[1] = 3;
      draw.facing = of_polygons ? facing.data() : nullptr;
      draw.front_is_clockwise = front_is_clockwise;
      draw.deferred = deferred;
      stage.render(isa, 0);
      const std::vector<std::uint32_t> both = stage.colors();
      stage.clear_draws();
      for (const std::uint32_t& id : mesh.visible) {
        TileDraw& one = add(stage, mesh, std::span(&id, 1));
        one.color_attribute[0] = one.color_attribute[1] = shows_back(id) ? 3 : 0;
      }
      stage.render(isa, 0);
      ASSERT_EQ(both, stage.colors()) << name_of(isa) << ", round " << round;
    }
  }
}

TEST(TileRenderer, SmallAndLargeTrianglePathsAgree) {
  RandomTriangles source(43, kTile);
  for (const bool deferred : {false, true}) {
    for (int round = 0; round < (long_tests() ? 3000 : 150); ++round) {
      const DepthFormat depth = round % 3 == 0 ? DepthFormat::float32 : DepthFormat::unorm24;
      TileHarness stage(kTile, kTile, kTile, depth);
      const Mesh mesh = random_mesh(source, 1, 3, depth, 0.5, 255.5);
      const InstructionSet isa =
          available_isas()[static_cast<std::size_t>(round / 3) % available_isas().size()];
      const auto draw_in = [&](int step) {
        stage.clear_draws();
        for (int y = 0; y < kTile; y += step) {
          for (int x = 0; x < kTile; x += step) {
            TileDraw& draw = add(stage, mesh);
            draw.rect = {x, y, std::min(x + step, kTile), std::min(y + step, kTile)};
            draw.uses_depth = true;
            draw.deferred = deferred;
          }
        }
        stage.render(isa, 0, 0x123456, depth == DepthFormat::float32 ? 0x3f800000 : 0xffffff);
        return std::pair(stage.colors(), stage.depths());
      };
      const auto whole = draw_in(kTile);
      const int step = source.between(1, 9);
      ASSERT_EQ(draw_in(step), whole) << name_of(isa) << ", windows of " << step << ": " << mesh.vertices[0].x
                                      << " " << mesh.vertices[0].y;
    }
  }
}

TEST(TileRenderer, ConstantColorsStayConstantUnderInterpolation) {
  RandomTriangles source(44, kTile);
  for (int round = 0; round < 200; ++round) {
    TileHarness stage(kTile, kTile, kTile);
    Mesh mesh = random_mesh(source, 8, 3, DepthFormat::none, 0, 0);
    const auto r = static_cast<std::uint32_t>(source.between(0, 255));
    const auto g = static_cast<std::uint32_t>(source.between(0, 255));
    const std::uint32_t b = 255;
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
      mesh.attributes[3 * i] = static_cast<float>(r) + 0.5f;
      // An integral level; any smaller value stores the level below.
      mesh.attributes[3 * i + 1] = static_cast<float>(g);
      mesh.attributes[3 * i + 2] = static_cast<float>(b) + 0.5f;
    }
    add(stage, mesh);
    for (const InstructionSet isa : available_isas()) {
      stage.render(isa, 0, 0xff000000u);
      for (const std::uint32_t word : stage.colors())
        ASSERT_TRUE(word == 0xff000000u || word == (r << 16 | g << 8 | b))
            << name_of(isa) << std::hex << " " << word;
    }
  }
}

// Values that a batch may hold at points outside all triangles.
void fill_with_odd_values(ShadingBatch& batch, RandomTriangles& source) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  constexpr float kOdd[] = {
      std::numeric_limits<float>::quiet_NaN(), kInfinity, -kInfinity, 1e-40f, 3e38f, -3e38f, -0.5f};
  for (auto& field : batch.field)
    for (float& value : field) value = kOdd[source.between(0, 6)];
}

// Per-pixel lighting gathers pixels of many triangles into batches. The colour of a pixel must not depend on
// the other pixels of its batch, or on the batch's previous contents.
TEST(TileRenderer, PixelLightingDoesNotDependOnTheBatch) {
  RandomTriangles source(45, kTile);
  RandomLighting lights(46);
  for (int round = 0; round < (long_tests() ? 1000 : 60); ++round) {
    LightingCase c = lights.next();
    c.renormalize = true;
    c.negate_normal = false;
    c.tracked = {};
    const LightingProgram front = c.program();
    c.negate_normal = true;
    const LightingProgram back = c.program();
    const Mesh mesh = random_mesh(source, 1 + source.between(0, 60), 6, DepthFormat::unorm24, -3, 3,
                                  round % 2 == 0 ? Sides::both : Sides::one);
    std::vector<std::uint32_t> first;
    for (const InstructionSet isa : available_isas()) {
      for (const bool at_once : {false, true}) {
        TileHarness stage(kTile, kTile, kTile, DepthFormat::unorm24);
        TileDraw& draw = add(stage, mesh);
        draw.source = ColorSource::per_pixel;
        draw.deferred = true;
        draw.uses_depth = true;
        draw.programs[0] = &front;
        draw.programs[1] = &back;
        for (std::uint8_t k = 0; k < 6; ++k) draw.fields[k] = static_cast<std::uint8_t>(kNormalX + k);
        stage.frame().shade_immediately = at_once;
        fill_with_odd_values(stage.workspace().memory().batch, source);
        stage.render(isa, 0, 0x123456, 0xffffff);
        if (first.empty()) first = stage.colors();
        ASSERT_EQ(stage.colors(), first) << name_of(isa) << (at_once ? ", each triangle by itself" : "");
      }
    }
  }
}

// More visible triangles than a tile can defer.
TEST(TileRenderer, DeferringInPortionsChangesNothing) {
  RandomTriangles source(47, kTile);
  Mesh mesh =
      random_mesh(source, static_cast<int>(2 * kMaxVisibleTriangles) + 100, 3, DepthFormat::none, 0.5, 255.5);
  TileHarness stage(kTile, kTile, kTile);
  for (const InstructionSet isa : available_isas()) {
    stage.clear_draws();
    add(stage, mesh).deferred = false;
    stage.render(isa, 0);
    const std::vector<std::uint32_t> expected = stage.colors();
    stage.clear_draws();
    add(stage, mesh).deferred = true;
    stage.render(isa, 0);
    EXPECT_EQ(stage.colors(), expected) << name_of(isa);
  }
}

PixelRect random_window(RandomTriangles& source) {
  if (source.between(0, 2) == 0) return {0, 0, kTile, kTile};
  const int x = source.between(0, kTile - 1), y = source.between(0, kTile - 1);
  return {x, y, source.between(x + 1, kTile), source.between(y + 1, kTile)};
}

// Alpha blending without other fragment operations has its own kernels: for full blocks in a row, for other
// blocks, and for single pixels. An alpha test that always passes selects the generic path instead.
TEST(TileRenderer, AlphaBlendingMatchesTheGenericPath) {
  RandomTriangles source(48, kTile);
  FragmentOps plain_blend;
  plain_blend.blend = true;
  FragmentOps generic = plain_blend;
  generic.alpha_test = true;
  generic.alpha_func = Compare::always;
  for (const DepthFormat kind : {DepthFormat::none, DepthFormat::unorm24, DepthFormat::float32})
    for (int round = 0; round < (long_tests() ? 3000 : 100); ++round) {
      const Mesh mesh = random_mesh(source, 1 + source.between(0, 20), 4, kind, -0.1, 1.1);
      const bool has_alpha = source.between(0, 2) != 0;
      const bool is_constant = source.between(0, 5) == 0;
      const PixelRect window = random_window(source);
      const std::uint32_t mask = source.between(0, 2) == 0 ? 0x5a5a5au : 0xffffffffu;
      for (const InstructionSet isa : available_isas()) {
        const auto draw_with = [&](const FragmentOps& ops) {
          TileHarness stage(kTile, kTile, kTile, kind);
          TileDraw& draw = add(stage, mesh);
          if (is_constant) draw.source = ColorSource::constant;
          draw.ops = &ops;
          draw.rect = window;
          draw.write_mask = mask;
          draw.scaled_colors = false;
          draw.uses_depth = kind != DepthFormat::none;
          for (const std::size_t face : {0, 1}) {
            draw.color[face] = {0.25f, 0.5f, 0.75f, 0.375f};
            draw.alpha_attribute[face] = has_alpha ? 3 : -1;
            draw.alpha[face] = 0.625f;
          }
          const TileCounts counts = stage.render(isa, 0, 0x123456, farthest_key(kind));
          return std::tuple(stage.colors(),
                            kind != DepthFormat::none ? stage.depths() : std::vector<std::int32_t>(),
                            counts.shaded_pixels);
        };
        ASSERT_EQ(draw_with(plain_blend), draw_with(generic))
            << name_of(isa) << (has_alpha ? ", alpha of the vertices" : "")
            << (is_constant ? ", one colour" : "");
      }
    }
}

// Without a mask full blocks are stored directly; with one they are merged with the stored bits.
TEST(TileRenderer, MasksSelectBitsOfTheUnmaskedResult) {
  constexpr std::uint32_t kBackground = 0x123456;
  RandomTriangles source(49, kTile);
  for (int round = 0; round < (long_tests() ? 3000 : 150); ++round) {
    const Mesh mesh = random_mesh(source, 1 + source.between(0, 20), 3, DepthFormat::none, 0.5, 255.5);
    const PixelRect window = random_window(source);
    for (const ColorSource colors : {ColorSource::constant, ColorSource::interpolated})
      for (const InstructionSet isa : available_isas()) {
        const auto draw_through = [&](std::uint32_t mask) {
          TileHarness stage(kTile, kTile, kTile);
          TileDraw& draw = add(stage, mesh);
          draw.source = colors;
          draw.packed_color = 0xabcdef;
          draw.rect = window;
          draw.write_mask = mask;
          stage.render(isa, 0, kBackground);
          return stage.colors();
        };
        const std::uint32_t mask = 0xf0f0f0f0u;
        std::vector<std::uint32_t> expected = draw_through(0xffffffffu);
        for (std::uint32_t& word : expected) word = (word & mask) | (kBackground & ~mask);
        ASSERT_EQ(draw_through(mask), expected) << name_of(isa);
      }
  }
}

}  // namespace
}  // namespace tessera::test::tile_renderer_test
