// Odd data is not an error: it is dropped and counted, and the rest of the frame is unchanged.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>

#include "tests/engine/frame/api_random_frame.h"

namespace tessera::frame_odd_data_test {
namespace {

using namespace test;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();
const FrameBufferFormat kFormat{.width = 90, .height = 70};

struct Result {
  FrameStats stats;
  Fingerprint pixels;
};
Result draw(const MeshData& mesh, const DrawState& state, RendererOptions options = {.threads = 1},
            const Camera& camera = {}) {
  FrameBuffer buffer(kFormat);
  Frame frame(buffer);
  frame.clear({.color = Color{0.1f, 0.1f, 0.1f, 1}});
  frame.set_camera(camera);
  frame.draw(mesh.view(), state);
  Result result;
  result.stats = Renderer(options).finish(frame);
  result.pixels = fingerprint(buffer);
  return result;
}

// Separate triangles in a row, without shared vertices, each with positions, normals and colours.
MeshData row_of_triangles(int count) {
  MeshData mesh;
  for (int i = 0; i < count; ++i) {
    const float x = -0.95f + 1.9f * static_cast<float>(i) / static_cast<float>(count);
    const float step = 1.5f / static_cast<float>(count);
    const float corners[3][2] = {{x, -0.8f}, {x + step, -0.7f}, {x, 0.8f}};
    for (const auto& corner : corners) {
      mesh.positions.insert(mesh.positions.end(), {corner[0], corner[1], 0.1f * static_cast<float>(i % 3)});
      mesh.normals.insert(mesh.normals.end(), {0.3f, 0.1f, 0.9f});
      mesh.colors.insert(mesh.colors.end(), {0.2f, 0.5f, 0.9f, 1});
    }
  }
  return mesh;
}
MeshData without(const MeshData& mesh, std::size_t triangle) {
  MeshData result = mesh;
  const auto cut = [&](std::vector<float>& values, std::size_t each) {
    if (values.empty()) return;
    const auto first = values.begin() + static_cast<std::ptrdiff_t>(3 * each * triangle);
    values.erase(first, first + static_cast<std::ptrdiff_t>(3 * each));
  };
  cut(result.positions, 3);
  cut(result.normals, 3);
  cut(result.colors, 4);
  return result;
}

std::uint64_t sum(const FrameStats& s) {
  return s.dropped_non_finite + s.trivially_rejected + s.culled + s.zero_area + s.clipped + s.binned;
}

void expect_dropped(const std::function<void(MeshData&)>& spoil, std::size_t triangle,
                    const DrawState& state) {
  const MeshData good = row_of_triangles(9);
  MeshData bad = good;
  spoil(bad);
  const Result rest = draw(without(good, triangle), state);
  for (const InstructionSet set : available_instruction_sets()) {
    const Result result = draw(bad, state, {.threads = 1, .instruction_set = set});
    EXPECT_EQ(result.stats.dropped_non_finite, 1u);
    EXPECT_EQ(result.stats.binned, 8u);
    EXPECT_EQ(sum(result.stats), result.stats.triangles_in);
    EXPECT_EQ(result.pixels, rest.pixels) << "the other triangles are unchanged";
  }
}

TEST(FrameOddData, NonFinitePositionsDropTheirTriangle) {
  for (const float value : {kNan, kInfinity, -kInfinity})
    for (std::size_t k = 0; k < 9; ++k)
      for (const Shading shading : {Shading::flat, Shading::gouraud, Shading::phong}) {
        DrawState state;
        state.shading = shading;
        expect_dropped([&](MeshData& mesh) { mesh.positions[4 * 9 + k] = value; }, 4, state);
      }
}

TEST(FrameOddData, PositionsOverflowingInTheTransformDropTheirTriangle) {
  DrawState state;
  state.transform = scale(1e300, 1, 1) * scale(1e-300, 1, 1);
  state.transform.m[0] = 1;
  const MeshData good = row_of_triangles(3);
  EXPECT_EQ(draw(good, state).stats.dropped_non_finite, 0u);
  DrawState huge;
  huge.transform = scale(1e305, 1, 1);
  MeshData far = good;
  for (float& p : far.positions) p *= 1e30f;
  const Result result = draw(far, huge);
  EXPECT_EQ(result.stats.dropped_non_finite, 3u);
}

TEST(FrameOddData, NonFiniteNormalsDropTheirTriangleIfNormalsAreUsed) {
  for (const float value : {kNan, kInfinity})
    for (const Shading shading : {Shading::flat, Shading::gouraud, Shading::phong}) {
      DrawState lit;
      lit.shading = shading;
      const auto spoil = [&](MeshData& mesh) { mesh.normals[9 * 2 + 5] = value; };
      expect_dropped(spoil, 2, lit);
      MeshData bad = row_of_triangles(9);
      spoil(bad);
      EXPECT_EQ(draw(bad, unlit({1, 1, 1, 1})).stats.binned, 9u) << "normals are not used";
    }
}

// The triangle is drawn and counted as usual, and the capture skips the odd normals.
TEST(FrameOddData, NonFiniteNormalsUsedByACaptureAloneDropNothing) {
  FrameBuffer buffer({.width = 16, .height = 16});
  Frame frame(buffer);
  MeshData mesh;
  mesh.positions = {-1, -1, 0, 3, -1, 0, -1, 3, 0};
  mesh.normals = {0, 0, 1, kNan, 0, 1, kInfinity, 0, 0};
  std::vector<float> normals(3 * 16 * 16, 7.0f);
  frame.capture({.normals = normals});
  frame.draw(mesh.view(), unlit({1, 1, 1, 1}));
  const FrameStats stats = Renderer({.threads = 1}).finish(frame);
  EXPECT_EQ(stats.dropped_non_finite, 0u);
  // The normal of the first vertex, the only finite one.
  for (std::size_t i = 0; i < normals.size(); ++i) ASSERT_FLOAT_EQ(normals[i], i % 3 == 2 ? 1.0f : 0.0f);
  const std::vector<std::uint32_t> words = packed_colors(buffer);
  EXPECT_EQ(std::count(words.begin(), words.end(), 0xffffffu), 16 * 16);
}

TEST(FrameOddData, NonFiniteColorsDropTheirTriangleIfColorsAreUsed) {
  for (const float value : {kNan, -kInfinity})
    for (const Shading shading : {Shading::flat, Shading::gouraud, Shading::phong}) {
      const auto spoil = [&](MeshData& mesh) { mesh.colors[12 * 7] = value; };
      DrawState tracked;
      tracked.shading = shading;
      tracked.color_material = ColorMaterial::diffuse;
      expect_dropped(spoil, 7, tracked);
      DrawState plain = unlit({});
      plain.shading = shading;
      expect_dropped(spoil, 7, plain);
      MeshData bad = row_of_triangles(9);
      spoil(bad);
      EXPECT_EQ(draw(bad, {}).stats.binned, 9u) << "colours are not used";
    }
}

TEST(FrameOddData, NonFiniteVertexDropsEveryTriangleThatUsesIt) {
  MeshData fan;
  fan.positions = {0, 0, 0};
  for (int i = 0; i < 8; ++i)
    fan.positions.insert(fan.positions.end(), {std::cos(0.785f * static_cast<float>(i)),
                                               std::sin(0.785f * static_cast<float>(i)), 0});
  for (std::uint32_t i = 1; i <= 7; ++i) fan.indices.insert(fan.indices.end(), {0, i, i + 1});
  fan.positions[3 * 3] = kNan;
  EXPECT_EQ(draw(fan, {}).stats.dropped_non_finite, 2u);
  fan.positions[3 * 3] = 0;
  fan.positions[0] = kNan;
  EXPECT_EQ(draw(fan, {}).stats.dropped_non_finite, 7u);
}

TEST(FrameOddData, UnusedNonFiniteVertexDropsNothing) {
  MeshData mesh = rectangle(-0.5f, -0.5f, 0.5f, 0.5f);
  const Result plain = draw(mesh, {});
  mesh.positions.insert(mesh.positions.end(), {kNan, kNan, kNan});
  const Result result = draw(mesh, {});
  EXPECT_EQ(result.stats.dropped_non_finite, 0u);
  EXPECT_EQ(result.stats.vertices, 5u);
  EXPECT_EQ(result.pixels, plain.pixels);
}

TEST(FrameOddData, ZeroAreaTrianglesAreCountedAndDrawNothing) {
  MeshData mesh;
  const auto add = [&mesh](const std::array<float, 9>& corners) {
    mesh.positions.insert(mesh.positions.end(), corners.begin(), corners.end());
  };
  add({0, 0, 0, 0, 0, 0, 0, 0, 0});                                    // all corners at one point
  add({-0.5f, -0.5f, 0, 0, 0, 0, 0.5f, 0.5f, 0});                      // collinear corners
  add({0.1f, 0.1f, 0, 0.1f, 0.1f, 0, 0.5f, 0, 0});                     // two equal corners
  add({0.2f, 0.2f, 0, 0.2f + 1e-6f, 0.2f, 0, 0.2f, 0.2f + 1e-6f, 0});  // below the grid of 1/256 pixel
  const Result result = draw(mesh, {});
  const Result empty = draw({}, {});
  EXPECT_EQ(result.stats.triangles_in, 4u);
  EXPECT_EQ(result.stats.zero_area, 4u);
  EXPECT_EQ(result.stats.shaded_pixels, 0u);
  EXPECT_EQ(result.pixels, empty.pixels);
}

TEST(FrameOddData, EmptyMeshesDrawNothing) {
  FrameBuffer buffer(kFormat);
  Frame frame(buffer);
  const std::vector<float> positions(9);
  frame.draw({}, {});
  frame.draw({.positions = std::span(positions).first(0), .position_components = 4}, {});
  EXPECT_EQ(frame.draw_count(), 2u);
  const FrameStats stats = Renderer({.threads = 1}).finish(frame);
  EXPECT_EQ(stats.vertices, 0u);
  EXPECT_EQ(stats.triangles_in, 0u);
  EXPECT_EQ(stats.shaded_pixels, 0u);
}

TEST(FrameOddData, TrianglesBehindTheEyeAreTriviallyRejected) {
  const RendererOptions in_full{.threads = 1, .elide = false};
  Camera camera;
  camera.projection = perspective(60, 9.0 / 7, 0.5, 50);
  MeshData mesh = row_of_triangles(6);
  const auto move_to = [&mesh](float z) {
    for (std::size_t i = 2; i < mesh.positions.size(); i += 3) mesh.positions[i] = z;
  };
  move_to(3);  // the camera faces -z
  const Result behind = draw(mesh, {}, in_full, camera);
  const Result empty = draw({}, {}, in_full, camera);
  EXPECT_EQ(behind.stats.trivially_rejected, 6u);
  EXPECT_EQ(behind.pixels, empty.pixels);
  move_to(0);  // in the eye's plane: w is 0
  EXPECT_EQ(draw(mesh, {}, in_full, camera).stats.trivially_rejected, 6u);
  move_to(-60);  // behind the far plane
  EXPECT_EQ(draw(mesh, {}, in_full, camera).stats.trivially_rejected, 6u);
  move_to(-3);
  EXPECT_EQ(draw(mesh, {}, in_full, camera).stats.binned, 6u);
}

TEST(FrameStatistics, AddUpWithoutClipping) {
  Random random(9);
  MeshData mesh;
  const auto add = [&](float x, float y, float size) {
    for (int k = 0; k < 3; ++k)
      mesh.positions.insert(
          mesh.positions.end(),
          {x + random.between(-size, size), y + random.between(-size, size), random.between(-0.9f, 0.9f)});
  };
  static constexpr float kSizes[] = {0.3f, 0.02f, 1e-5f};
  for (int i = 0; i < 3000; ++i) add(random.between(-2, 2), random.between(-2, 2), kSizes[i % 3]);
  for (int i = 0; i < 40; ++i) mesh.positions[static_cast<std::size_t>(9 * 17 * i + i % 9)] = kNan;
  for (const Cull cull : {Cull::none, Cull::back, Cull::front}) {
    DrawState state;
    state.cull = cull;
    FrameStats first;
    for (const InstructionSet set : available_instruction_sets())
      for (const int tile_size : {32, 128}) {
        const FrameStats stats =
            draw(mesh, state, {.threads = 2, .tile_size = tile_size, .instruction_set = set}).stats;
        EXPECT_EQ(stats.vertices, 9000u);
        EXPECT_EQ(stats.triangles_in, 3000u);
        EXPECT_EQ(stats.dropped_non_finite, 40u);
        EXPECT_EQ(stats.clipped, 0u);
        EXPECT_EQ(sum(stats), stats.triangles_in);
        for (const std::uint64_t part : {stats.trivially_rejected, stats.zero_area, stats.binned})
          EXPECT_GT(part, 100u);
        EXPECT_EQ(stats.culled > 0, cull != Cull::none);
        EXPECT_GE(stats.bin_entries, stats.binned / 2);
        EXPECT_EQ(stats.tiles, tile_size == 32 ? 9u : 1u);
        EXPECT_LE(stats.tiles_touched, stats.tiles);
        if (first.triangles_in == 0) first = stats;
        EXPECT_EQ(stats.binned, first.binned);
        EXPECT_EQ(stats.zero_area, first.zero_area);
        EXPECT_EQ(stats.culled, first.culled);
      }
  }
}

TEST(FrameStatistics, BelongToOneFrame) {
  FrameBuffer buffer(kFormat);
  Frame frame(buffer);
  Renderer renderer({.threads = 1});
  const MeshData mesh = row_of_triangles(5);
  for (int round = 0; round < 3; ++round) {
    frame.draw(mesh.view(), {});
    EXPECT_EQ(renderer.finish(frame).triangles_in, 5u);
  }
  EXPECT_EQ(renderer.finish(frame).triangles_in, 0u);
}

}  // namespace
}  // namespace tessera::frame_odd_data_test
