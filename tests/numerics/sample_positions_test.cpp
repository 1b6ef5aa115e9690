// Positions of the 4 and 8 samples of a pixel, to 1/256 pixel, the contents of each sample, and the resolve:
// through the public interface, against exact integers.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>

#include "tests/numerics/color_components.h"
#include "tests/numerics/exact.h"
#include "tests/raster/random_triangles.h"

namespace tessera::test::sample_positions_test {
namespace {

// Every multiple of 1/256 pixel is exact in float.
constexpr int kSide = 256;
constexpr int kScale = 256;

struct Place {  // 1/256 pixel, y down from the top row
  std::int64_t x, y;
};
using Corners = std::array<Place, 3>;

// The specification's table, in 1/16 pixel from the centre, y down.
const std::vector<Place>& positions(int samples) {
  static const std::vector<Place> kFour{{-2, -6}, {6, -2}, {-6, 2}, {2, 6}};
  static const std::vector<Place> kEight{{1, -3}, {-1, 3},  {5, 1}, {-3, -5},
                                         {-5, 5}, {-7, -1}, {3, 7}, {7, -7}};
  return samples == 4 ? kFour : kEight;
}
Place sample(int x, int y, int samples, std::size_t k) {
  const Place& p = positions(samples)[k];
  return {kScale * x + kScale / 2 + 16 * p.x, kScale * y + kScale / 2 + 16 * p.y};
}

// Whether the triangle covers the point. A point on an edge counts as moved by (e, e^2) to the right and
// down, for an infinitely small e: the top-left rule.
bool covers(const Corners& t, const Place& p) {
  const auto turn = [](const Place& a, const Place& b, const Place& c) {
    return Int128{b.x - a.x} * (c.y - a.y) - Int128{b.y - a.y} * (c.x - a.x);
  };
  const Int128 area = turn(t[0], t[1], t[2]);
  if (area == 0) return false;
  for (std::size_t k = 0; k < 3; ++k) {
    const Place& a = area > 0 ? t[k] : t[(k + 1) % 3];
    const Place& b = area > 0 ? t[(k + 1) % 3] : t[k];
    const Int128 at = turn(a, b, p);
    const Int128 by_e = -(b.y - a.y);
    const Int128 by_e2 = b.x - a.x;
    const bool is_outside_on_edge = by_e != 0 ? by_e < 0 : by_e2 <= 0;
    if (at != 0 ? at < 0 : is_outside_on_edge) return false;
  }
  return true;
}

/// Triangles drawn as one mesh: with given corners, or covering a single sample of a pixel only.
struct Triangles {
  MeshData mesh;
  void add(const Corners& corners, double depth = 0.5) {
    for (const Place& p : corners)
      mesh.positions.insert(mesh.positions.end(), {static_cast<float>(p.x) / (kScale * kSide / 2) - 1,
                                                   1 - static_cast<float>(p.y) / (kScale * kSide / 2),
                                                   static_cast<float>(2 * depth - 1)});
  }
  void add_at(const Place& p, double depth = 0.5) { add({p, {p.x + 1, p.y}, {p.x, p.y + 1}}, depth); }
  void color(const Color& c) {
    for (int v = 0; v < 3; ++v) mesh.colors.insert(mesh.colors.end(), {c.r, c.g, c.b, c.a});
  }
};

int mean_level(std::int64_t sum, int samples) { return static_cast<int>(Ratio{sum, samples}.rounded()); }

class SamplePositions : public testing::TestWithParam<int> {
 protected:
  const int samples = GetParam();
  FrameBufferFormat format() const { return {.width = kSide, .height = kSide, .samples = samples}; }
};

// One triangle of 1/256 pixel for each of the 65536 positions within a pixel, each in its own pixel, with the
// right angle in each corner of the grid square. It covers a sample only at its top left corner.
TEST_P(SamplePositions, MatchTheSpecificationToOne256thOfAPixel) {
  constexpr int kHalf = kSide;
  for (int corner = 0; corner < 4; ++corner)
    for (const bool turned : {false, true})
      for (const InstructionSet set : available_instruction_sets()) {
        Triangles triangles;
        std::vector<std::uint32_t> expected;
        std::int64_t covered = 0;
        for (int y = 0; y < kHalf; ++y)
          for (int x = 0; x < kHalf; ++x) {
            const Place p{kScale * x + x, kScale * y + y};
            const Place q{p.x + 1, p.y + 1};
            const Place square[4] = {p, {q.x, p.y}, q, {p.x, q.y}};
            Corners t{square[corner], square[(corner + 1) % 4], square[(corner + 3) % 4]};
            if (turned) std::swap(t[1], t[2]);
            triangles.add(t);
            int count = 0;
            for (std::size_t k = 0; k < static_cast<std::size_t>(samples); ++k)
              count += covers(t, sample(x, y, samples, k));
            covered += count;
            expected.push_back(0x010101u * static_cast<std::uint32_t>(mean_level(255 * count, samples)));
          }
        FrameBuffer buffer(format());
        Frame frame(buffer);
        frame.draw(triangles.mesh.view(), unlit({1, 1, 1, 1}));
        Renderer({.threads = 1, .instruction_set = set}).finish(frame);
        EXPECT_EQ(covered, corner == 0 || corner == 1 ? samples : 0);
        ASSERT_TRUE(packed_colors(buffer) == expected)
            << "corner " << corner << (turned ? ", turned" : "") << ", " << name(set);
      }
}

// Edges of all directions that pass through a sample exactly or miss it by 1/256 pixel on either side.
TEST_P(SamplePositions, AreOnTheRightSideOfNearbyEdges) {
  Random random(9);
  const auto between = [&](int low, int high) {
    return low + static_cast<int>(random.next() % static_cast<unsigned>(high - low + 1));
  };
  Renderer renderer({.threads = 1});
  FrameBuffer buffer(format());
  for (int round = 0; round < (long_tests() ? 100 : 2); ++round) {
    std::vector<Triangles> triangles;
    std::vector<std::uint32_t> expected;
    for (int y = 0; y < kSide; ++y)
      for (int x = 0; x < kSide; ++x) {
        expected.push_back(0);
        if ((x + y) % 16 != round % 16) continue;
        const std::size_t near = random.next() % static_cast<unsigned>(samples);
        const Place s = sample(x, y, samples, near);
        const Place along{between(-3000, 3000), between(-3000, 3000)};
        const Place off{between(-1, 1), between(-1, 1)};
        const int before = between(0, 3);
        const int after = between(1, 3);
        const Corners t{Place{s.x + off.x - before * along.x, s.y + off.y - before * along.y},
                        Place{s.x + off.x + after * along.x, s.y + off.y + after * along.y},
                        Place{s.x + between(-30000, 30000), s.y + between(-30000, 30000)}};
        triangles.emplace_back().add(t);
        int count = 0;
        for (std::size_t k = 0; k < static_cast<std::size_t>(samples); ++k)
          count += covers(t, sample(x, y, samples, k));
        expected.back() = 0x010101u * static_cast<std::uint32_t>(mean_level(255 * count, samples));
      }
    Frame frame(buffer);
    frame.clear({.color = Color{0, 0, 0, 1}});
    std::size_t i = 0;
    for (int y = 0; y < kSide; ++y)
      for (int x = 0; x < kSide; ++x) {
        if ((x + y) % 16 != round % 16) continue;
        DrawState white = unlit({1, 1, 1, 1});
        white.depth.enabled = false;
        white.scissor = Rect{x, kSide - 1 - y, 1, 1};
        frame.draw(triangles[i++].mesh.view(), white);
      }
    renderer.finish(frame);
    ASSERT_TRUE(packed_colors(buffer) == expected) << "round " << round;
  }
}

// Each sample of each pixel has a different level. The resolve stores their mean per component, rounded to
// the nearest level, halves up.
TEST_P(SamplePositions, AreResolvedToTheMeanOfTheirLevels) {
  constexpr int kUsed = 40;
  Random random(10);
  for (int color_bits = 1; color_bits <= 24; ++color_bits)
    for (const int alpha_bits : {0, 8}) {
      FrameBufferFormat f = format();
      f.color_bits = color_bits;
      f.alpha_bits = alpha_bits;
      const ComponentBits split(f);
      Triangles triangles;
      std::vector<std::uint32_t> expected(std::size_t{kUsed} * kUsed);
      for (int y = 0; y < kUsed; ++y)
        for (int x = 0; x < kUsed; ++x) {
          std::array<std::int64_t, 4> sums{};
          for (std::size_t k = 0; k < static_cast<std::size_t>(samples); ++k) {
            std::array<std::uint32_t, 4> levels{};
            for (std::size_t c = 0; c < 4; ++c)
              levels[c] = random.next() % static_cast<std::uint32_t>(split.levels(c) + 1);
            if (split.is_luminance()) levels[1] = levels[2] = levels[0];
            const auto component = [&](std::size_t c) {
              return split.bits[c] == 0 ? 1.0f
                                        : static_cast<float>(levels[c]) / static_cast<float>(split.levels(c));
            };
            triangles.add_at(sample(x, y, samples, k));
            triangles.color({component(0), component(1), component(2), component(3)});
            for (std::size_t c = 0; c < 4; ++c) sums[c] += levels[c];
          }
          std::uint32_t& word = expected[static_cast<std::size_t>(y * kUsed + x)];
          for (std::size_t c = 0; c < 4; ++c)
            if (split.bits[c] > 0)
              word |= static_cast<std::uint32_t>(mean_level(sums[c], samples)) << split.shift[c];
        }
      for (const InstructionSet set : available_instruction_sets())
        for (const Shading shading : {Shading::flat, Shading::gouraud}) {
          FrameBuffer buffer(f);
          Frame frame(buffer);
          DrawState state = unlit({});
          state.shading = shading;
          frame.draw(triangles.mesh.view(), state);
          Renderer({.threads = 1, .instruction_set = set}).finish(frame);
          const auto words = packed_colors(buffer);
          for (int y = 0; y < kUsed; ++y)
            for (int x = 0; x < kUsed; ++x)
              ASSERT_EQ(words[static_cast<std::size_t>(y * kSide + x)],
                        expected[static_cast<std::size_t>(y * kUsed + x)])
                  << color_bits << " colour bits, " << alpha_bits << " of alpha, pixel " << x << ", " << y
                  << ", " << name(set);
        }
    }
}

// Depth and stencil are per sample within a frame; the stored values are those of sample 0.
TEST_P(SamplePositions, HaveTheirOwnDepthAndStencil) {
  constexpr int kUsed = 16;
  for (const DepthFormat depth_format :
       {DepthFormat::unorm16, DepthFormat::unorm24, DepthFormat::unorm32, DepthFormat::float32}) {
    FrameBufferFormat f = format();
    f.depth = depth_format;
    const auto count = static_cast<std::size_t>(samples);
    std::vector<Triangles> layers(count);
    for (std::size_t k = 0; k < count; ++k)
      for (int y = 0; y < kUsed; ++y)
        for (int x = 0; x < kUsed; ++x)
          layers[k].add_at(sample(x, y, samples, k), static_cast<double>(k + 1) / 16);
    for (std::size_t shown = 0; shown < count; ++shown) {
      FrameBuffer buffer(f);
      Frame frame(buffer);
      for (std::size_t k = 0; k < count; ++k) {
        DrawState state = unlit({});
        state.color_mask = {false, false, false, false};
        state.stencil =
            StencilState{.front = {.ref = static_cast<std::uint32_t>(10 + k), .zpass = StencilOp::replace}};
        frame.draw(layers[k].mesh.view(), state);
      }
      // Red where the stencil value is that of sample `shown`; blue added to samples whose depth lies behind
      // a plane between this sample's depth and the next.
      DrawState red = unlit({1, 0, 0, 1});
      DrawState blue = unlit({0, 0, 1, 1});
      red.depth.enabled = false;
      red.stencil =
          StencilState{.front = {.func = Compare::equal, .ref = static_cast<std::uint32_t>(10 + shown)}};
      blue.depth.write = false;
      blue.blend = BlendState{.src = BlendFactor::one, .dst = BlendFactor::one};
      const MeshData window = whole_window();
      const MeshData plane = rectangle(
          -1, -1, 1, 1, static_cast<float>(2 * (static_cast<double>(shown + 1) / 16 + 1 / 32.0) - 1));
      frame.draw(window.view(), red);
      frame.draw(plane.view(), blue);
      Renderer({.threads = 1}).finish(frame);
      const auto words = packed_colors(buffer);
      const auto stencil = stencil_values(buffer);
      std::vector<float> depths(pixel_count(buffer));
      buffer.read_depth(depths);
      for (int y = 0; y < kUsed; ++y)
        for (int x = 0; x < kUsed; ++x) {
          const std::size_t i = static_cast<std::size_t>(y * kSide + x);
          const int reds = mean_level(255, samples);
          const int blues = mean_level(255 * (samples - 1 - static_cast<int>(shown)), samples);
          ASSERT_EQ(words[i], static_cast<std::uint32_t>(reds << 16 | blues))
              << "sample " << shown << ", pixel " << x << ", " << y;
          ASSERT_EQ(stencil[i], 10);
          ASSERT_NEAR(depths[i], 1 / 16.0f, depth_format == DepthFormat::unorm16 ? 1 / 65535.0 : 0x1p-23);
        }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Patterns, SamplePositions, testing::Values(4, 8),
                         [](const auto& count) { return "Of" + std::to_string(count.param); });

}  // namespace
}  // namespace tessera::test::sample_positions_test
