// Triangles behind everything in their tile are left out before their setup: the bits stay those of the frame
// in full, also where depths are one level apart or equal.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tests/engine/frame/api_support.h"

namespace tessera::hidden_triangles_test {
namespace {

using namespace test;

constexpr int kSide = 96;  // pixels

/// A grid of 2 x 40 x 40 small triangles over more than the window, and at the depth of `depth_at`.
template <class DepthAt>
MeshData fine_grid(const DepthAt& depth_at) {
  constexpr std::uint32_t kQuads = 40, kPoints = kQuads + 1;
  MeshData mesh;
  for (std::uint32_t i = 0; i < kPoints * kPoints; ++i) {
    const float x = -1.05f + 2.1f * static_cast<float>(i % kPoints) / kQuads;
    const float y = -1.05f + 2.1f * static_cast<float>(i / kPoints) / kQuads;
    mesh.positions.insert(mesh.positions.end(), {x, y, static_cast<float>(depth_at(x, y))});
  }
  for (std::uint32_t row = 0; row < kQuads; ++row)
    for (std::uint32_t column = 0; column < kQuads; ++column) {
      const std::uint32_t a = row * kPoints + column, b = a + kPoints;
      mesh.indices.insert(mesh.indices.end(), {a, a + 1, b + 1, a, b + 1, b});
    }
  return mesh;
}

struct Scene {
  FrameBufferFormat format{.width = kSide, .height = kSide};
  std::vector<MeshData> meshes;
  std::vector<DrawState> states;
  bool clears_between = false;  ///< depth is cleared before the last mesh
};

struct Outcome {
  Fingerprint planes;
  FrameStats stats;
};
Outcome outcome(const Scene& scene, const RendererOptions& options) {
  FrameBuffer buffer(scene.format);
  Frame frame(buffer);
  frame.clear({.color = Color{0.1f, 0.2f, 0.3f, 1}, .depth = 1.0});
  for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
    if (scene.clears_between && i + 1 == scene.meshes.size()) frame.clear({.depth = 1.0});
    frame.draw(scene.meshes[i].view(), scene.states[i]);
  }
  Renderer renderer(options);
  const FrameStats stats = renderer.finish(frame);
  return {fingerprint(buffer), stats};
}

/// Checks that the scene has the same bits with and without hidden triangles, and returns the number of
/// hidden ones at a tile size of 32.
std::uint64_t hidden_triangles(const Scene& scene, const std::string& what) {
  const Outcome in_full = outcome(scene, {.threads = 1, .elide = false});
  EXPECT_EQ(in_full.stats.hidden_triangles, 0u) << what;
  std::uint64_t hidden = 0;
  for (const InstructionSet isa : available_instruction_sets())
    for (const int tile_size : {128, 64, 32})
      for (const bool defers : {false, true}) {
        const Outcome elided = outcome(scene, {.threads = 1,
                                               .tile_size = tile_size,
                                               .instruction_set = isa,
                                               .debug = {.defer_shading = defers}});
        EXPECT_EQ(elided.planes, in_full.planes)
            << what << ", tile size " << tile_size << (defers ? ", deferred" : ", immediate");
        if (!defers) {
          EXPECT_EQ(elided.stats.shaded_pixels,
                    outcome(scene, {.threads = 1, .elide = false, .debug = {.defer_shading = false}})
                        .stats.shaded_pixels)
              << what;
        }
        hidden = elided.stats.hidden_triangles;
      }
  return hidden;
}

DrawState drawn(Color color, Compare test) {
  DrawState state = unlit(color);
  state.depth.test = test;
  return state;
}

constexpr DepthFormat kFormats[] = {DepthFormat::unorm16, DepthFormat::unorm24, DepthFormat::unorm32,
                                    DepthFormat::float32};
constexpr Color kFront{0.9f, 0.4f, 0.2f, 1}, kBack{0.2f, 0.5f, 0.9f, 1};

TEST(HiddenTriangles, AreLeftOutBehindASquare) {
  for (const DepthFormat format : kFormats)
    for (const Compare test : {Compare::less, Compare::lequal}) {
      const Scene scene{.format = {.width = kSide, .height = kSide, .depth = format},
                        .meshes = {whole_window(-0.5f), fine_grid([](float x, float) { return 0.3f * x; })},
                        .states = {drawn(kFront, test), drawn(kBack, test)}};
      EXPECT_GT(hidden_triangles(scene, "format " + std::to_string(static_cast<int>(format))), 2000u);
    }
}

// Parallel planes that are a few levels apart: depth 0.5 + level / (2^bits - 1).
TEST(HiddenTriangles, KeepTheBitsOfPlanesAFewLevelsApart) {
  for (const DepthFormat format : kFormats)
    for (const Compare test : {Compare::less, Compare::lequal})
      for (int levels = -3; levels <= 3; ++levels) {
        const int bits = format == DepthFormat::unorm16 ? 16 : 24;
        const float step = std::ldexp(1.0f, 1 - bits);
        const Scene scene{.format = {.width = kSide, .height = kSide, .depth = format},
                          .meshes = {whole_window(0), fine_grid([&](float, float) {
                                       return step * static_cast<float>(levels);
                                     })},
                          .states = {drawn(kFront, Compare::less), drawn(kBack, test)}};
        hidden_triangles(scene, "format " + std::to_string(static_cast<int>(format)) + ", " +
                                    std::to_string(levels) + " levels behind");
      }
}

// Both meshes are rough and steep, so that depths within a triangle come near the depths of its vertices.
TEST(HiddenTriangles, KeepTheBitsOfRoughSurfaces) {
  std::uint64_t hidden = 0;
  for (int round = 0; round < 40; ++round) {
    Random random(static_cast<std::uint64_t>(round));
    const DepthFormat format = kFormats[round % 4];
    const float roughness = std::ldexp(1.0f, -static_cast<int>(random.next() % 20));
    const float distance = random.between(-1, 4) * roughness;
    const float slope = random.between(-0.5f, 0.5f) * roughness;
    const auto rough = [&](float offset) {
      return fine_grid(
          [&](float x, float) { return offset + slope * x + random.between(-roughness, roughness); });
    };
    const Scene scene{.format = {.width = kSide, .height = kSide, .depth = format},
                      .meshes = {rough(0), rough(0.2f * distance), rough(distance)},
                      .states = {drawn(kFront, Compare::less), drawn(kBack, Compare::lequal),
                                 drawn({1, 1, 0, 1}, Compare::less)}};
    hidden += hidden_triangles(scene, "round " + std::to_string(round));
  }
  EXPECT_GT(hidden, 10000u);
}

TEST(HiddenTriangles, AreDrawnAfterAClearOfTheDepthBuffer) {
  const Scene scene{.meshes = {whole_window(-0.5f), fine_grid([](float, float) { return 0.5f; }),
                               fine_grid([](float, float) { return 0.2f; })},
                    .states = {drawn(kFront, Compare::less), drawn(kBack, Compare::less),
                               drawn({0, 1, 0, 1}, Compare::less)},
                    .clears_between = true};
  EXPECT_GT(hidden_triangles(scene, "cleared"), 2000u);
}

TEST(HiddenTriangles, AreFoundWithinTheScissorRectangle) {
  Scene scene{.meshes = {whole_window(-0.5f), fine_grid([](float, float) { return 0.5f; })},
              .states = {drawn(kFront, Compare::less), drawn(kBack, Compare::less)}};
  std::uint64_t hidden = 0;
  for (const Rect rect : {Rect{5, 7, 60, 61}, Rect{32, 32, 32, 32}, Rect{30, 1, 3, 90}}) {
    scene.states[0].scissor = Rect{rect.x - 4, rect.y - 4, rect.width + 8, rect.height + 8};
    scene.states[1].scissor = rect;
    hidden += hidden_triangles(scene, "both scissored");
    // One pixel of the square is missing: what is behind it shows through.
    scene.states[0].scissor = Rect{rect.x + 1, rect.y, rect.width, rect.height};
    hidden_triangles(scene, "a column shows through");
  }
  EXPECT_GT(hidden, 500u);
}

TEST(HiddenTriangles, AreSetUpIfTheirFailuresCount) {
  Scene scene{.format = {.width = kSide, .height = kSide, .stencil_bits = 8},
              .meshes = {whole_window(-0.5f), fine_grid([](float, float) { return 0.5f; })},
              .states = {drawn(kFront, Compare::less), drawn(kBack, Compare::less)}};
  scene.states[1].stencil = StencilState{.front = {.zfail = StencilOp::incr}};
  EXPECT_EQ(hidden_triangles(scene, "stencil counts failures"), 0u);
  scene.states[1].stencil.reset();
  scene.states[1].depth.test = Compare::greater;
  EXPECT_EQ(hidden_triangles(scene, "greater"), 0u);
  scene.states[1].depth.test = Compare::less;
  scene.states[1].polygon_offset = {.factor = 0, .units = -4};
  EXPECT_EQ(hidden_triangles(scene, "offset"), 0u);
}

TEST(HiddenTriangles, KeepTheBitsUnderBlendingAndAlphaTests) {
  Scene scene{.meshes = {whole_window(-0.5f), fine_grid([](float x, float) { return 0.6f * x - 0.3f; })},
              .states = {drawn(kFront, Compare::less), drawn({0.2f, 0.5f, 0.9f, 0.5f}, Compare::lequal)}};
  scene.states[1].blend = BlendState{};
  EXPECT_GT(hidden_triangles(scene, "blending"), 500u);
  scene.states[1].blend.reset();
  scene.states[1].alpha_test = AlphaTest{.func = Compare::less, .ref = 0.7f};
  EXPECT_GT(hidden_triangles(scene, "alpha test"), 500u);
}

TEST(HiddenTriangles, DoNotChangeFragmentCounts) {
  const Scene scene{.meshes = {whole_window(-0.5f), fine_grid([](float, float) { return 0.5f; })},
                    .states = {drawn(kFront, Compare::less), drawn(kBack, Compare::less)}};
  const auto fragments = [&](bool elide) {
    return outcome(scene, {.threads = 1, .elide = elide, .debug = {.count_fragments = true}}).stats.fragments;
  };
  EXPECT_EQ(fragments(true), 2u * kSide * kSide);
  EXPECT_EQ(fragments(false), 2u * kSide * kSide);
}

}  // namespace
}  // namespace tessera::hidden_triangles_test
