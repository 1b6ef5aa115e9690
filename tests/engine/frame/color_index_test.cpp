// Colour-index buffers: vertex indices are interpolated, rounded, masked and combined. Small cases are
// computed by hand.
#include <cmath>
#include <limits>

#include "tests/engine/frame/index_pictures.h"

namespace tessera::color_index_test {
namespace {

using namespace test;
using testing::AllOf;
using testing::Each;
using testing::HasSubstr;
using testing::Not;

double masked(double index, double count) { return index - count * std::floor(index / count); }

TEST(ColorIndex, IsInterpolatedFromMaskedVertices) {
  const float corners[][3] = {{2, 34, 10},
                              {-3, 70, 64.25f},
                              {63.75f, 63.75f, 62.875f},
                              {1000.25f, -1000.75f, 0.25f},
                              {-128, 6.5e4f, 17}};
  for (const auto& [a, b, c] : corners) {
    const MeshData mesh = large_triangle(a, b, c);
    const double at[3] = {masked(a, 64), masked(b, 64), masked(c, 64)};
    for (const DrawState& state : every_pixel_path(index_state())) {
      const PackedColors words = drawn(kIndexFormat, [&](Frame& frame) { frame.draw(mesh.view(), state); });
      for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 64; ++x) {
          const double index = at[0] + (at[1] - at[0]) * (x + 0.5) / 128 + (at[2] - at[0]) * (y + 0.5) / 64;
          if (std::abs(index + 0.5 - std::round(index + 0.5)) < 1e-4) continue;
          const auto expected = static_cast<std::uint32_t>(masked(std::floor(index + 0.5), 64));
          ASSERT_EQ(words[static_cast<std::size_t>((31 - y) * 64 + x)], expected)
              << "at " << x << " " << y << " of " << a << " " << b << " " << c << ": " << index;
        }
    }
  }
}

TEST(ColorIndex, IsRoundedToNearestAndMaskedAgain) {
  FrameBufferFormat deep = kIndexFormat;
  deep.color_bits = 24;
  struct Case {
    float index;
    std::uint32_t word;
    std::uint32_t deep_word;
  };
  const Case cases[] = {{2.5f, 3, 3},          {3.5f, 4, 4},
                        {3.4999f, 3, 3},       {0.49999997f, 0, 0},
                        {63.5f, 0, 64},        {63.25f, 63, 63},
                        {-0.5f, 0, 0},         {-0.75f, 63, 16777215},
                        {8388609, 1, 8388609}, {16777215, 63, 16777215},
                        {16777216, 0, 0},      {-1e-30f, 0, 0},
                        {3e38f, 0, 0}};
  for (const Case& c : cases) {
    for (const Shading shading : {Shading::flat, Shading::gouraud, Shading::phong}) {
      SCOPED_TRACE(c.index);
      expect_everywhere(c.word, large_triangle(c.index, c.index, c.index), index_state(shading));
      if (c.index != -0.75f)
        expect_everywhere(c.deep_word, large_triangle(c.index, c.index, c.index), index_state(shading), deep);
    }
  }
}

TEST(ColorIndex, FlatTrianglesUseTheProvokingVertex) {
  DrawState state = index_state(Shading::flat);
  expect_everywhere(13, large_triangle(5, 9, 13), state);
  expect_everywhere(61, large_triangle(5, 9, -3), state);
  state.provoking_vertex = ProvokingVertex::first;
  expect_everywhere(5, large_triangle(5, 9, 13), state);
}

TEST(ColorIndex, IsNeverDithered) {
  FrameBufferFormat format = kIndexFormat;
  format.palette = named_palette("ega16", 6);
  const MeshData mesh = large_triangle(0, 60, 20);
  const auto record = [&](Frame& frame) { frame.draw(mesh.view(), index_state()); };
  const PackedColors plain = drawn(format, record);
  format.dither = Dither::bayer8;
  EXPECT_EQ(drawn(format, record), plain);
}

TEST(ColorIndex, ColorsApplyWhereIndicesDoNot) {
  MeshData mesh = large_triangle(40, 41, 42);
  mesh.colors = {1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1};
  const auto record = [&](Frame& frame) { frame.draw(mesh.view(), index_state()); };
  const FrameBufferFormat rgb{.width = 64, .height = 32};
  EXPECT_THAT(drawn(kIndexFormat, record), Not(Each(12u)));
  DrawState lit;
  lit.color_material = ColorMaterial::emission;
  mesh.colors = {1, 0.33f, 0.33f, 1, 1, 0.33f, 0.33f, 1, 1, 0.33f, 0.33f, 1};
  lit.material.ambient = lit.material.diffuse = {0, 0, 0, 1};
  expect_everywhere(12, mesh, lit);  // bright red of ega16
  FrameBuffer buffer(rgb);
  Frame frame(buffer);
  frame.draw(mesh.view(), index_state());
  Renderer({.threads = 1}).finish(frame);
  EXPECT_THAT(packed_colors(buffer), Each(0xff5454u));
}

TEST(ColorIndex, XorDrawnTwiceRestoresTheBuffer) {
  const MeshData below = large_triangle(0, 63, 20);
  const MeshData above = large_triangle(9, 40, 63);
  DrawState state = index_state();
  state.depth.enabled = false;
  const auto draws = [&](int times) {
    return drawn(kIndexFormat, [&](Frame& frame) {
      frame.draw(below.view(), state);
      DrawState cursor = state;
      cursor.logic_op = LogicOp::bit_xor;
      for (int i = 0; i < times; ++i) frame.draw(above.view(), cursor);
    });
  };
  const PackedColors before = draws(0);
  const PackedColors once = draws(1);
  EXPECT_EQ(draws(2), before);
  const PackedColors alone = drawn(kIndexFormat, [&](Frame& frame) { frame.draw(above.view(), state); });
  for (std::size_t i = 0; i < once.size(); ++i) ASSERT_EQ(once[i], before[i] ^ alone[i]);
}

TEST(ColorIndex, RespectsThePlaneMask) {
  DrawState state = index_state();
  state.plane_mask = 0b000111;
  const MeshData mesh = large_triangle(0b101010, 0b101010, 0b101010);
  const PackedColors words = drawn(kIndexFormat, [&](Frame& frame) {
    frame.clear({.index = 0b010101});
    frame.draw(mesh.view(), state);
  });
  EXPECT_THAT(words, Each(0b010010u));
}

TEST(ColorIndex, ErrorsNameTheFault) {
  FrameBuffer buffer(kIndexFormat);
  Frame frame(buffer);
  MeshData mesh = large_triangle(1, 2, 3);
  mesh.color_indices.pop_back();
  EXPECT_THAT(error_of([&] { frame.draw(mesh.view(), index_state()); }).value_or(""),
              AllOf(HasSubstr("2 floats of color_indices"), HasSubstr("3 vertices")));
  mesh.color_indices = {1, 2, 3};
  DrawState state;
  state.material = index_material(0, std::numeric_limits<float>::infinity(), 1, 0);
  EXPECT_THAT(error_of([&] { frame.draw(mesh.view(), state); }).value_or(""),
              AllOf(HasSubstr("material.index_ramp"), HasSubstr("finite")));
  state = index_state();
  state.blend = BlendState{};
  EXPECT_THAT(error_of([&] { frame.draw(mesh.view(), state); }).value_or(""), HasSubstr("do not blend"));
  state.blend.reset();
  state.alpha_test = AlphaTest{};
  EXPECT_THAT(error_of([&] { frame.draw(mesh.view(), state); }).value_or(""), HasSubstr("no alpha"));
}

TEST(ColorIndex, NonFiniteIndicesDropTheirTriangleIfUsed) {
  MeshData mesh = two_faces();
  mesh.color_indices.assign(8, 7);
  for (const float wrong :
       {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    mesh.color_indices[2] = wrong;
    for (const Shading shading : {Shading::flat, Shading::gouraud}) {
      const auto dropped = [&](const FrameBufferFormat& format, DrawState state) {
        state.shading = shading;
        FrameBuffer buffer(format);
        Frame frame(buffer);
        frame.draw(mesh.view(), state);
        return Renderer({.threads = 1}).finish(frame).dropped_non_finite;
      };
      EXPECT_EQ(dropped(kIndexFormat, index_state()), 2u) << "both triangles of the left half";
      EXPECT_EQ(dropped(kIndexFormat, DrawState{}), 0u) << "lit";
      EXPECT_EQ(dropped({.width = 64, .height = 32}, index_state()), 0u) << "RGB buffers ignore indices";
    }
  }
}

// Also strided arrays, 16-bit indices and captures.
TEST(ColorIndex, BitsDoNotDependOnLayoutOrRendererOptions) {
  Random random(5);
  MeshData mesh;
  for (int i = 0; i < 600; ++i) {
    mesh.positions.insert(mesh.positions.end(), {random.between(-1.3f, 1.3f), random.between(-1.3f, 1.3f),
                                                 random.between(-1.1f, 0.9f)});
    mesh.normals.insert(mesh.normals.end(),
                        {random.between(-1, 1), random.between(-1, 1), random.between(0, 1)});
    mesh.color_indices.push_back(random.between(-300, 300));
  }
  FrameBufferFormat format = kIndexFormat;
  format.width = 150;
  format.height = 110;
  format.dither = Dither::bayer4;
  Light point;
  point.position = {0.5f, 0.5f, 2, 1};
  const auto record = [&](Frame& frame) {
    frame.set_lights({Light{}, point});
    frame.set_light_model({.two_sided = true});
    for (const DrawState& way : every_pixel_path({})) {
      for (const Shading shading : {Shading::flat, Shading::gouraud, Shading::phong}) {
        DrawState state = way;
        state.shading = shading;
        state.viewport = Rect{40 * static_cast<int>(shading), 0, 70, 110};
        state.material = index_material(-20, 50, 90, 12);
        frame.draw(mesh.view(), state);
        state.back_material = Material{};
        frame.draw(mesh.view(), state);
        state.lighting = false;
        frame.draw(mesh.view(), state);
      }
    }
  };
  const PackedColors expected = drawn(format, record);
  for (const InstructionSet set : available_instruction_sets())
    for (const int tile_size : {32, 64, 128})
      for (const int threads : {1, 3})
        for (const bool defer : {true, false})
          ASSERT_EQ(drawn(format, record,
                          {.threads = threads,
                           .tile_size = tile_size,
                           .instruction_set = set,
                           .debug = {.defer_shading = defer}}),
                    expected)
              << name(set) << ", tiles of " << tile_size << ", " << threads << " threads, deferred " << defer;
}

TEST(ColorIndex, DoesNotChangeCaptures) {
  const MeshData mesh = with_normals(0, 0, 2);
  DrawState plain = index_state();
  plain.depth.test = Compare::lequal;
  for (const DrawState& state : every_pixel_path(plain)) {
    PackedColors draw_ids(64 * 32);
    PackedColors primitive_ids(64 * 32);
    std::vector<float> normals(3 * 64 * 32);
    const PackedColors words = drawn(kIndexFormat, [&](Frame& frame) {
      frame.draw(mesh.view(), state);
      frame.draw(mesh.view(), state);
      frame.capture({.draw_ids = draw_ids, .primitive_ids = primitive_ids, .normals = normals});
    });
    EXPECT_EQ(words, drawn(kIndexFormat, [&](Frame& frame) { frame.draw(mesh.view(), state); }));
    EXPECT_THAT(draw_ids, Each(1u)) << "the second draw, not its index";
    EXPECT_THAT(primitive_ids, Each(0u));
    for (std::size_t i = 0; i < normals.size(); ++i) ASSERT_EQ(normals[i], i % 3 == 2 ? 1.0f : 0.0f);
  }
}

std::string explain(const FrameBufferFormat& format, const MeshData& mesh, const DrawState& state) {
  FrameBuffer buffer(format);
  Frame frame(buffer);
  frame.draw(mesh.view(), state);
  return frame.explain(0);
}

TEST(ColorIndex, ExplainNamesUnusedInputs) {
  MeshData mesh = large_triangle(1, 2, 3);
  mesh.colors.assign(12, 1);
  FrameBufferFormat dithered = kIndexFormat;
  dithered.dither = Dither::bayer2;
  EXPECT_THAT(explain(dithered, mesh, index_state()),
              AllOf(HasSubstr("colour indices: on"),
                    HasSubstr("vertex colours: ignored, the mesh has colour indices"),
                    HasSubstr("dither: skipped, colour indices are stored")));
  const FrameBufferFormat rgb{.width = 4, .height = 4};
  EXPECT_THAT(explain(rgb, mesh, index_state()),
              HasSubstr("colour indices: ignored, the frame buffer holds RGB"));
  EXPECT_THAT(explain(kIndexFormat, mesh, {}),
              AllOf(HasSubstr("colour indices: ignored, the draw is lit"), Not(HasSubstr("index lighting"))));
  DrawState state;
  state.color_material = ColorMaterial::diffuse;
  state.material = index_material(0, 1, 2, 3);
  EXPECT_THAT(explain(kIndexFormat, mesh, state),
              AllOf(HasSubstr("index lighting: on"), HasSubstr("highlight: Blinn"),
                    HasSubstr("vertex colours: ignored, the material has an index_ramp")));
  EXPECT_THAT(explain(rgb, mesh, state),
              AllOf(HasSubstr("index lighting: ignored, the frame buffer holds RGB"),
                    Not(HasSubstr("index lighting: on"))));
}

}  // namespace
}  // namespace tessera::color_index_test
