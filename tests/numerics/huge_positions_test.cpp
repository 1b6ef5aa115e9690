// Vertices at the limits of float and double: the visible part of their triangles and lines is still right,
// and inexact results stay within the window.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include "tests/engine/frame/api_support.h"
#include "tests/numerics/bounds.h"
#include "tests/numerics/case_renderer.h"

namespace tessera::test::huge_positions_test {
namespace {

constexpr int kSide = 64;
constexpr std::uint32_t kRed = 0xff0000;

std::vector<std::uint32_t> words_of(const MeshData& mesh, const DrawState& state, const Camera& camera,
                                    InstructionSet set, int samples = 1) {
  FrameBuffer buffer({.width = kSide, .height = kSide, .samples = samples});
  Frame frame(buffer);
  frame.set_camera(camera);
  frame.draw(mesh.view(), state);
  Renderer({.threads = 1, .instruction_set = set}).finish(frame);
  return packed_colors(buffer);
}

MeshData mesh_of(Primitive primitive, std::vector<float> positions) {
  MeshData mesh;
  mesh.primitive = primitive;
  mesh.positions = std::move(positions);
  return mesh;
}

// Half of the window, behind an edge through its centre: below, above, left or right.
TEST(HugePositions, TrianglesCoverTheirHalfOfTheWindow) {
  for (const InstructionSet set : available_instruction_sets())
    for (const int samples : {1, 4})
      for (const float far : {1e6f, 1e15f, 1e17f, 1e30f, 3e38f})
        for (int side = 0; side < 4; ++side)
          for (const bool turned : {false, true})
            for (const Primitive primitive :
                 {Primitive::triangles, Primitive::polygon, Primitive::triangle_fan}) {
              const float sign = side % 2 == 0 ? -1.0f : 1.0f;
              std::vector<float> positions{-far, 0, 0, far, 0, 0, 0, sign * far, 0};
              if (side >= 2)
                for (std::size_t v = 0; v < 3; ++v) std::swap(positions[3 * v], positions[3 * v + 1]);
              if (turned)
                for (std::size_t k = 0; k < 3; ++k) std::swap(positions[k], positions[3 + k]);
              const auto words =
                  words_of(mesh_of(primitive, positions), unlit({1, 0, 0, 1}), {}, set, samples);
              for (int y = 0; y < kSide; ++y)
                for (int x = 0; x < kSide; ++x) {
                  const int along = side < 2 ? kSide - 1 - y : x;
                  ASSERT_EQ(words[static_cast<std::size_t>(y * kSide + x)],
                            (sign < 0) == (along < kSide / 2) ? kRed : 0)
                      << far << ", side " << side << ", pixel " << x << ", " << y;
                }
            }
}

// The same halves, counted, for Mesa's figure.
TEST(HugePositions, NoPixelIsInTheWrongHalf) {
  expect_figure("pixels wrong behind an edge with ends at 10^6 to 3 10^38", 0, "pixels",
                [](const MakeRenderer& make, bool) {
                  const std::unique_ptr<CaseRenderer> renderer = make({.width = kSide, .height = kSide});
                  long double wrong = 0;
                  for (const float far : {1e6f, 1e15f, 1e17f, 1e30f, 3e38f})
                    for (const float sign : {-1.0f, 1.0f}) {
                      const CasePicture& picture =
                          renderer->draw({{.positions = {-far, 0, 0, 1, far, 0, 0, 1, 0, sign * far, 0, 1}}});
                      for (std::size_t i = 0; i < picture.colors.size(); ++i) {
                        const bool is_covered = picture.colors[i][0] > 0.5f;
                        wrong += is_covered == ((sign > 0) == (i < picture.colors.size() / 2)) ? 0 : 1;
                      }
                    }
                  return wrong;
                });
}

TEST(HugePositions, TrianglesAroundTheWindowCoverAllOfIt) {
  for (const InstructionSet set : available_instruction_sets())
    for (const float far : {1e6f, 1e15f, 1e20f, 1e30f, 1e38f})
      for (int turn = 0; turn < 24; ++turn) {
        std::vector<float> positions;
        for (int k = 0; k < 3; ++k) {
          const double angle = 0.2618 * turn + 2.0944 * k;
          positions.insert(positions.end(), {far * static_cast<float>(std::cos(angle)),
                                             far * static_cast<float>(std::sin(angle)), 0});
        }
        const auto words = words_of(mesh_of(Primitive::triangles, positions), unlit({1, 0, 0, 1}), {}, set);
        ASSERT_EQ(std::count(words.begin(), words.end(), kRed), kSide * kSide) << far << ", turn " << turn;
      }
}

TEST(HugePositions, LinesCrossTheWholeWindow) {
  for (const float far : {1e6f, 1e15f, 1e17f, 1e30f, 3e38f})
    for (const bool standing : {false, true})
      for (const float end : {far, 2.0f}) {
        std::vector<float> positions{-far, 1 / 64.0f, 0, end, 1 / 64.0f, 0};
        if (standing)
          for (std::size_t v = 0; v < 2; ++v) std::swap(positions[3 * v], positions[3 * v + 1]);
        const auto words = words_of(mesh_of(Primitive::lines, positions), unlit({1, 0, 0, 1}), {},
                                    InstructionSet::automatic);
        for (int y = 0; y < kSide; ++y)
          for (int x = 0; x < kSide; ++x) {
            const bool is_on_line = standing ? x == kSide / 2 : y == kSide / 2 - 1;
            ASSERT_EQ(words[static_cast<std::size_t>(y * kSide + x)], is_on_line ? kRed : 0)
                << far << ", " << end << ": " << x << ", " << y;
          }
      }
}

// Clip coordinates are homogeneous: scaling them changes nothing. Depth and coverage do not use the float
// 1/w.
TEST(HugePositions, ScalingTheProjectionByAPowerOfTwoChangesNothing) {
  Random random(6);
  MeshData mesh;
  for (int i = 0; i < 150; ++i)
    for (int k = 0; k < 9; ++k) mesh.positions.push_back(random.between(-4, 4) * (i % 3 == 0 ? 20.0f : 1.0f));
  for (const PolygonMode mode : {PolygonMode::fill, PolygonMode::line, PolygonMode::point})
    for (const InstructionSet set : available_instruction_sets()) {
      std::vector<std::uint32_t> expected;
      for (const int exponent : {0, -900, -300, 40, 300, 990, 1000, 1010, 1015}) {
        Camera camera{.projection = perspective(60, 1, 0.5, 50)};
        for (double& element : camera.projection.m) element = std::ldexp(element, exponent);
        DrawState state = unlit({1, 0, 0, 1});
        state.front_mode = state.back_mode = mode;
        FrameBuffer buffer({.width = kSide, .height = kSide});
        Frame frame(buffer);
        frame.set_camera(camera);
        frame.draw(mesh.view(), state);
        const FrameStats stats = Renderer({.threads = 1, .instruction_set = set}).finish(frame);
        ASSERT_EQ(stats.dropped_non_finite, 0u) << exponent;
        std::vector<std::uint32_t> found = packed_colors(buffer);
        const std::vector<std::uint32_t> depths = stored_depths(buffer);
        found.insert(found.end(), depths.begin(), depths.end());
        if (expected.empty()) expected = found;
        ASSERT_TRUE(found == expected)
            << "2^" << exponent << " on " << name(set) << ", mode " << static_cast<int>(mode);
      }
    }
}

}  // namespace
}  // namespace tessera::test::huge_positions_test
