// Polygons drawn as lines or points, compared with the lines and points of their boundary, with facing,
// culling, colours and offset of the whole polygon. Software drivers are known to fail at culled faces and at
// offsets of outlines; both have a test here.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "tests/engine/frame/api_support.h"

namespace tessera::polygon_mode_test {
namespace {

using namespace test;
using testing::HasSubstr;

constexpr int kWidth = 96, kHeight = 80;

// A convex polygon around a centre, counter-clockwise, in an inclined plane.
MeshData ring(Random& random, std::uint32_t corners) {
  MeshData mesh;
  mesh.primitive = Primitive::polygon;
  if (corners == 3) mesh.primitive = Primitive::triangles;
  if (corners == 4) mesh.primitive = Primitive::quads;
  const float x = random.between(-0.5f, 0.5f);
  const float y = random.between(-0.5f, 0.5f);
  const float size = random.between(0.3f, 1.1f);
  const float lean = random.between(-0.4f, 0.4f);
  const float turn = random.between(0, 6);
  for (std::uint32_t i = 0; i < corners; ++i) {
    const float angle = turn + 6.2831853f * static_cast<float>(i) / static_cast<float>(corners);
    const float dx = size * std::cos(angle);
    const float dy = size * std::sin(angle);
    for (const float c : {x + dx, y + dy, lean * dx - 0.2f * lean * dy}) mesh.positions.push_back(c);
    for (int c = 0; c < 4; ++c) mesh.colors.push_back(c == 3 ? 1 : random.between(0.1f, 1));
  }
  return mesh;
}
MeshData turned(const MeshData& mesh) {
  MeshData other = mesh;
  other.indices.clear();
  for (auto i = static_cast<std::uint32_t>(mesh.vertex_count()); i-- > 0;) other.indices.push_back(i);
  return other;
}
MeshData as(Primitive primitive, MeshData mesh) {
  mesh.primitive = primitive;
  return mesh;
}

// All of them use the kernels with fragment operations: other kernels may round colours differently.
DrawState plain() {
  DrawState state;
  state.lighting = false;
  state.point_size = 3;
  state.alpha_test = AlphaTest{.func = Compare::greater, .ref = 0};
  return state;
}
DrawState outlined(PolygonMode front, PolygonMode back) {
  DrawState state = plain();
  state.front_mode = front;
  state.back_mode = back;
  return state;
}

struct Step {
  MeshData mesh;
  DrawState state;
};
std::vector<std::uint32_t> drawn(const std::vector<Step>& steps, int tile_size = 64, int samples = 1) {
  FrameBuffer buffer({.width = kWidth, .height = kHeight, .samples = samples});
  Frame frame(buffer);
  frame.clear({.color = Color{0, 0, 0, 1}, .depth = 1});
  for (const Step& step : steps) frame.draw(step.mesh.view(), step.state);
  Renderer({.threads = 1, .tile_size = tile_size}).finish(frame);
  return packed_colors(buffer);
}
std::ptrdiff_t lit(const std::vector<std::uint32_t>& words) {
  return std::count_if(words.begin(), words.end(), [](std::uint32_t w) { return w != 0; });
}

TEST(PolygonMode, DrawsTheBoundaryWithoutDiagonals) {
  Random random(61);
  for (int turn = 0; turn < 60; ++turn) {
    const MeshData mesh = ring(random, 3 + static_cast<std::uint32_t>(turn) % 5);
    for (const int samples : {1, 4}) {
      const std::vector<std::uint32_t> lines =
          drawn({{as(Primitive::line_loop, mesh), plain()}}, 64, samples);
      const std::vector<std::uint32_t> points = drawn({{as(Primitive::points, mesh), plain()}}, 64, samples);
      ASSERT_GT(lit(lines), 20);
      ASSERT_EQ(drawn({{mesh, outlined(PolygonMode::line, PolygonMode::fill)}}, 32, samples), lines) << turn;
      ASSERT_EQ(drawn({{mesh, outlined(PolygonMode::point, PolygonMode::line)}}, 64, samples), points)
          << turn;
    }
    ASSERT_EQ(drawn({{mesh, outlined(PolygonMode::fill, PolygonMode::point)}}), drawn({{mesh, plain()}}))
        << turn;
  }
}

TEST(PolygonMode, DependsOnTheVisibleFace) {
  Random random(62);
  for (int turn = 0; turn < 30; ++turn) {
    const MeshData front = ring(random, 3 + static_cast<std::uint32_t>(turn) % 5);
    const MeshData back = turned(front);
    const PolygonMode modes[] = {PolygonMode::fill, PolygonMode::line, PolygonMode::point};
    for (const PolygonMode one : modes)
      for (const PolygonMode other : modes) {
        ASSERT_EQ(drawn({{back, outlined(other, one)}}), drawn({{back, outlined(one, one)}}));
        DrawState clockwise = outlined(one, other);
        clockwise.front_face = FrontFace::cw;
        ASSERT_EQ(drawn({{back, clockwise}}), drawn({{back, outlined(one, one)}}));
      }
  }
}

// A known bug of Mesa's software driver.
TEST(PolygonMode, CullsFacesInEveryMode) {
  Random random(63);
  for (int turn = 0; turn < 30; ++turn) {
    const MeshData front = ring(random, 3 + static_cast<std::uint32_t>(turn) % 5);
    const MeshData back = turned(front);
    for (const PolygonMode mode : {PolygonMode::fill, PolygonMode::line, PolygonMode::point}) {
      DrawState culled = outlined(mode, mode);
      culled.cull = Cull::back;
      EXPECT_EQ(lit(drawn({{back, culled}})), 0);
      EXPECT_EQ(drawn({{front, culled}, {back, culled}}), drawn({{front, outlined(mode, mode)}}));
      culled.cull = Cull::front;
      EXPECT_EQ(lit(drawn({{front, culled}})), 0);
      EXPECT_EQ(drawn({{front, culled}, {back, culled}}), drawn({{back, outlined(mode, mode)}}));
    }
  }
}

// Front-facing needs a positive area [GL 2.1, 3.5.1].
TEST(PolygonMode, PolygonsWithoutAreaAreBackFacing) {
  MeshData mesh;
  mesh.positions = {-0.4f, -0.4f, 0, 0.4f, 0.4f, 0, -0.4f, -0.4f, 0};
  const auto pixels = [&](const DrawState& state) {
    FrameBuffer buffer({.width = 64, .height = 64});
    Frame frame(buffer);
    frame.clear({.color = Color{0, 0, 0, 1}, .depth = 1.0});
    frame.draw(mesh.view(), state);
    Renderer({.threads = 1}).finish(frame);
    const std::vector<std::uint32_t> words = packed_colors(buffer);
    return std::count_if(words.begin(), words.end(), [](std::uint32_t w) { return (w & 0xffffff) != 0; });
  };
  for (const FrontFace front_face : {FrontFace::ccw, FrontFace::cw})
    for (const PolygonMode mode : {PolygonMode::line, PolygonMode::point}) {
      DrawState state{.lighting = false, .front_face = front_face, .front_mode = mode, .back_mode = mode};
      const auto all = pixels(state);
      EXPECT_GT(all, 0);
      state.cull = Cull::front;
      EXPECT_EQ(pixels(state), all) << "a back face";
      state.cull = Cull::back;
      EXPECT_EQ(pixels(state), 0) << "a back face";
      state.cull = Cull::none;
      state.front_mode = PolygonMode::fill;
      EXPECT_EQ(pixels(state), all) << "drawn in the mode of back faces";
    }
}

// Two-sided lighting takes the front material [GL 2.1, 2.14.1].
TEST(PolygonMode, PolygonsWithoutAreaAreLitAsFronts) {
  MeshData mesh;
  mesh.positions = {-0.4f, -0.4f, 0, 0.4f, 0.4f, 0, -0.4f, -0.4f, 0};
  FrameBuffer buffer({.width = 64, .height = 64});
  Frame frame(buffer);
  frame.clear({.color = Color{0, 0, 0, 1}, .depth = 1.0});
  frame.set_lights(std::span<const Light>{});
  frame.set_light_model({.ambient = {0, 0, 0, 1}, .two_sided = true});
  frame.draw(mesh.view(), {.material = {.emission = {1, 0, 0, 1}},
                           .back_material = Material{.emission = {0, 0, 1, 1}},
                           .front_mode = PolygonMode::line,
                           .back_mode = PolygonMode::line});
  Renderer({.threads = 1}).finish(frame);
  const std::vector<std::uint32_t> words = packed_colors(buffer);
  const auto count = [&](std::uint32_t color) {
    return std::count_if(words.begin(), words.end(),
                         [&](std::uint32_t word) { return (word & 0xffffff) == color; });
  };
  EXPECT_GT(count(0xff0000), 0) << "the front material";
  EXPECT_EQ(count(0x0000ff), 0) << "the back material";
}

// Outlines over their own polygon: all visible if moved nearer; if moved away, none inside the polygon is
// visible. A known bug of Mesa's software driver.
TEST(PolygonMode, UsesThePolygonsOffset) {
  Random random(64);
  for (const DepthFormat depth :
       {DepthFormat::unorm16, DepthFormat::unorm24, DepthFormat::unorm32, DepthFormat::float32})
    for (int turn = 0; turn < 40; ++turn) {
      MeshData mesh = ring(random, 3 + static_cast<std::uint32_t>(turn) % 5);
      MeshData black = mesh;
      for (std::size_t c = 0; c < black.colors.size(); ++c) black.colors[c] = c % 4 == 3 ? 1.0f : 0.0f;
      const auto shown = [&](float factor, float units) {
        FrameBuffer buffer({.width = kWidth, .height = kHeight, .depth = depth});
        Frame frame(buffer);
        frame.clear({.color = Color{0, 0, 0, 1}, .depth = 1});
        if (factor != 0) frame.draw(black.view(), plain());
        DrawState state = outlined(turn % 2 == 0 ? PolygonMode::line : PolygonMode::point, PolygonMode::fill);
        state.polygon_offset = {factor, units};
        frame.draw(mesh.view(), state);
        Renderer({.threads = 1}).finish(frame);
        return packed_colors(buffer);
      };
      const std::vector<std::uint32_t> alone = shown(0, 0);
      ASSERT_EQ(shown(-2, -2), alone) << turn;
      // Outside the filled polygon nothing hides the lines, so only filled pixels are compared.
      std::vector<std::uint32_t> hidden = shown(2, 2);
      MeshData white = mesh;
      white.colors.assign(white.colors.size(), 1.0f);
      FrameBuffer buffer({.width = kWidth, .height = kHeight, .depth = depth});
      Frame frame(buffer);
      frame.clear({.color = Color{0, 0, 0, 1}, .depth = 1});
      frame.draw(white.view(), plain());
      Renderer({.threads = 1}).finish(frame);
      const std::vector<std::uint32_t> filled = packed_colors(buffer);
      for (std::size_t i = 0; i < hidden.size(); ++i)
        ASSERT_EQ(hidden[i], filled[i] != 0 ? 0u : alone[i]) << turn << ", pixel " << i;
    }
}

TEST(PolygonMode, FlatOutlinesUseThePolygonsColor) {
  Random random(65);
  for (int turn = 0; turn < 20; ++turn) {
    const std::uint32_t corners = 3 + static_cast<std::uint32_t>(turn) % 5;
    const MeshData mesh = ring(random, corners);
    for (const ProvokingVertex convention : {ProvokingVertex::last, ProvokingVertex::first}) {
      DrawState state = outlined(PolygonMode::line, PolygonMode::line);
      state.shading = Shading::flat;
      state.provoking_vertex = convention;
      const std::size_t vertex = corners > 4 || convention == ProvokingVertex::first ? 0 : corners - 1;
      std::uint32_t word = 0;
      for (std::size_t c = 0; c < 3; ++c)
        word = word << 8 | static_cast<std::uint32_t>(mesh.colors[4 * vertex + c] * 255 + 0.5f);
      const std::vector<std::uint32_t> words = drawn({{mesh, state}});
      EXPECT_GT(lit(words), 20);
      EXPECT_EQ(lit(words), std::count(words.begin(), words.end(), word)) << turn;
    }
  }
}

// The lines and points of a plane that rises along x move by the slope of the plane.
TEST(PolygonMode, OffsetIsSlopeTimesFactorPlusUnits) {
  MeshData mesh;
  mesh.primitive = Primitive::quads;
  mesh.positions = {-0.75f, -0.5f, -0.375f, 0.75f, -0.5f, 0.375f, 0.75f, 0.5f, 0.375f, -0.75f, 0.5f, -0.375f};
  for (const PolygonMode mode : {PolygonMode::line, PolygonMode::point}) {
    const auto depths = [&](float factor, float units) {
      FrameBuffer buffer({.width = kWidth, .height = kHeight});
      Frame frame(buffer);
      frame.clear({.color = Color{0, 0, 0, 1}, .depth = 1});
      DrawState state = outlined(mode, mode);
      state.polygon_offset = {factor, units};
      frame.draw(mesh.view(), state);
      Renderer({.threads = 1}).finish(frame);
      return stored_depths(buffer);
    };
    const std::vector<std::uint32_t> before = depths(0, 0);
    const std::vector<std::uint32_t> after = depths(3, 5);
    const double moved = 3 * (0.375 / (0.75 * kWidth)) * 0xffffff + 5;
    int count = 0;
    for (std::size_t i = 0; i < before.size(); ++i) {
      if (before[i] == 0xffffff) continue;
      ++count;
      ASSERT_NEAR(static_cast<double>(after[i]) - before[i], moved, 1.5) << i;
    }
    EXPECT_GE(count, mode == PolygonMode::line ? 200 : 36);
  }
}

// The boundary of a clipped polygon closes along the clip plane.
TEST(PolygonMode, ClosesTheBoundaryAlongTheClipPlane) {
  MeshData mesh;
  mesh.primitive = Primitive::quads;
  mesh.positions = {-0.75f, -0.5f, -1.5f, 0.75f,  -0.5f, 0.5f,
                    0.75f,  0.5f,  0.5f,  -0.75f, 0.5f,  -1.5f};  // x is -0.375 at the near plane
  mesh.colors.assign(16, 1.0f);
  const std::vector<std::uint32_t> words = drawn({{mesh, outlined(PolygonMode::line, PolygonMode::line)}});
  constexpr std::size_t column = 29;  // the edge lies between 29 and 30 and belongs to the left pixel
  int count = 0;
  for (std::size_t y = 0; y < kHeight; ++y) count += words[y * kWidth + column] != 0;
  EXPECT_GE(count, kHeight / 2 - 1);
  FrameBuffer buffer({.width = kWidth, .height = kHeight});
  Frame frame(buffer);
  frame.draw(mesh.view(), outlined(PolygonMode::line, PolygonMode::line));
  EXPECT_EQ(Renderer({.threads = 1}).finish(frame).clipped, 2u) << "both triangles of the quad";
}

TEST(PolygonMode, CapturesThePolygonAndItsDraw) {
  Random random(66);
  const MeshData first = ring(random, 5);
  MeshData second = ring(random, 4);
  const MeshData other = ring(random, 4);
  second.positions.insert(second.positions.end(), other.positions.begin(), other.positions.end());
  second.colors.insert(second.colors.end(), other.colors.begin(), other.colors.end());
  FrameBuffer buffer({.width = kWidth, .height = kHeight});
  Frame frame(buffer);
  std::vector<std::uint32_t> draw_ids(std::size_t{kWidth} * kHeight);
  std::vector<std::uint32_t> primitive_ids(draw_ids.size());
  frame.capture({.draw_ids = draw_ids, .primitive_ids = primitive_ids});
  frame.draw(first.view(), outlined(PolygonMode::line, PolygonMode::fill));
  frame.clear({.depth = 1});
  frame.draw(second.view(), outlined(PolygonMode::point, PolygonMode::line));
  Renderer({.threads = 1}).finish(frame);
  const std::vector<std::uint32_t> lines = drawn({{as(Primitive::line_loop, first), plain()}});
  const std::vector<std::uint32_t> points = drawn({{as(Primitive::points, second), plain()}});
  const std::vector<std::uint32_t> late = drawn({{as(Primitive::points, other), plain()}});
  std::ptrdiff_t late_pixels = 0;
  for (std::size_t i = 0; i < draw_ids.size(); ++i) {
    const std::uint32_t below = lines[i] != 0 ? 0u : Capture::kNothing;
    ASSERT_EQ(draw_ids[i], points[i] != 0 ? 1u : below);
    ASSERT_TRUE(primitive_ids[i] == (draw_ids[i] == Capture::kNothing ? Capture::kNothing : 0u) ||
                (primitive_ids[i] == 1 && late[i] != 0));
    late_pixels += primitive_ids[i] == 1;
  }
  EXPECT_GT(late_pixels, 9);
}

}  // namespace
}  // namespace tessera::polygon_mode_test
