// Coverage samples through the public interface: their coverage by an independent rule in exact integers, the
// values stored after a frame, and the memory of buffers, which store no samples.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "tests/engine/frame/api_support.h"

namespace tessera::samples_test {
namespace {

using namespace test;

// Powers of two: every multiple of 1/256 pixel is exact in a float's window coordinate.
constexpr int kWidth = 256;
constexpr int kHeight = 128;
constexpr int kScale = 256;

FrameBufferFormat format_of(int samples) { return {.width = kWidth, .height = kHeight, .samples = samples}; }

/// In 1/256 pixel, y down from the top row.
struct Point {
  std::int64_t x, y;
};
using Triangle = std::array<Point, 3>;

void add(MeshData& mesh, const Point& p, float z = 0) {
  mesh.positions.push_back(static_cast<float>(p.x) / (kScale * kWidth / 2) - 1);
  mesh.positions.push_back(1 - static_cast<float>(p.y) / (kScale * kHeight / 2));
  mesh.positions.push_back(z);
}
MeshData mesh_of(const Triangle& triangle) {
  MeshData mesh;
  for (const Point& p : triangle) add(mesh, p);
  return mesh;
}

/// Sample positions of Direct3D 11, in 1/16 pixel from the centre, y down.
const std::vector<Point>& pattern(int samples) {
  static const std::vector<Point> kOne{{0, 0}};
  static const std::vector<Point> kFour{{-2, -6}, {6, -2}, {-6, 2}, {2, 6}};
  static const std::vector<Point> kEight{{1, -3}, {-1, 3},  {5, 1}, {-3, -5},
                                         {-5, 5}, {-7, -1}, {3, 7}, {7, -7}};
  if (samples == 1) return kOne;
  return samples == 4 ? kFour : kEight;
}
Point sample_of(int x, int y, const Point& offset) {
  return {kScale * x + kScale / 2 + offset.x * (kScale / 16),
          kScale * y + kScale / 2 + offset.y * (kScale / 16)};
}

/// True if the triangle covers the point. A point on an edge is covered if the edge is a left or top edge:
/// the triangle lies to its right or below.
bool covers(Triangle t, const Point& p) {
  const auto side = [](const Point& a, const Point& b, const Point& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  };
  const std::int64_t area = side(t[0], t[1], t[2]);
  if (area == 0) return false;
  if (area < 0) std::swap(t[1], t[2]);  // clockwise in the window: left edges go up, top edges go right
  for (std::size_t k = 0; k < 3; ++k) {
    const Point& a = t[k];
    const Point& b = t[(k + 1) % 3];
    const std::int64_t inside = side(a, b, p);
    const bool is_left = b.y < a.y;
    const bool is_top = b.y == a.y && b.x > a.x;
    const bool owns_edge = is_left || is_top;
    if (inside < 0 || (inside == 0 && !owns_edge)) return false;
  }
  return true;
}
int covered_samples(const Triangle& t, int x, int y, int samples) {
  return static_cast<int>(
      std::count_if(pattern(samples).begin(), pattern(samples).end(),
                    [&](const Point& offset) { return covers(t, sample_of(x, y, offset)); }));
}
bool in(const std::optional<Rect>& scissor, int x, int y) {
  if (!scissor) return true;
  const int from_below = kHeight - 1 - y;
  const bool is_in_columns = x >= scissor->x && x < scissor->x + scissor->width;
  const bool is_in_rows = from_below >= scissor->y && from_below < scissor->y + scissor->height;
  return is_in_columns && is_in_rows;
}
std::uint32_t mean_level(int sum, int samples) {
  return static_cast<std::uint32_t>(std::floor(static_cast<double>(sum) / samples + 0.5));
}

Point random_point(Random& random) {
  return {below(random, kWidth * kScale), below(random, kHeight * kScale)};
}

/// Tiny and large triangles, slivers, vertices on sample positions and tile borders, and triangles far larger
/// than the window.
Triangle random_triangle(Random& random, int turn) {
  const Point center = random_point(random);
  Triangle t;
  for (Point& p : t) {
    const auto around = [&](std::int64_t reach) {
      return Point{center.x + below(random, 2 * reach + 1) - reach,
                   center.y + below(random, 2 * reach + 1) - reach};
    };
    switch (turn % 6) {
      case 0: p = around(300); break;
      case 1: p = around(8 * kScale); break;
      case 2: p = random_point(random); break;
      case 3:
        p = {20 * below(random, kWidth * kScale) - 8 * kWidth * kScale,
             20 * below(random, kHeight * kScale) - 8 * kHeight * kScale};
        break;
      case 4:
        p = sample_of(static_cast<int>(below(random, kWidth)), static_cast<int>(below(random, kHeight)),
                      pattern(8)[random.next() % 8]);
        break;
      default:
        p = {32 * kScale * (below(random, 3) + 3) + below(random, 257) - 128,
             32 * kScale * (below(random, 3) + 1) + below(random, 257) - 128};
    }
  }
  return t;
}

class FrameSamples : public testing::TestWithParam<int> {
 protected:
  const int samples = GetParam();
};

TEST_P(FrameSamples, AreCoveredByAnExactRule) {
  Renderer renderers[3] = {Renderer({.threads = 1, .tile_size = 32}),
                           Renderer({.threads = 1, .tile_size = 64}),
                           Renderer({.threads = 1, .tile_size = 128})};
  Random random(31);
  std::uint64_t partly_covered = 0;
  for (int turn = 0; turn < 180; ++turn) {
    const Triangle triangle = random_triangle(random, turn);
    const MeshData mesh = mesh_of(triangle);
    DrawState white = unlit({1, 1, 1, 1});
    if (turn % 4 == 3) {
      const int x = static_cast<int>(below(random, kWidth));
      const int y = static_cast<int>(below(random, kHeight));
      white.scissor = Rect{x / 2, y / 2, 1 + static_cast<int>(below(random, kWidth)),
                           1 + static_cast<int>(below(random, kHeight))};
    }
    std::vector<std::uint32_t> expected;
    std::uint64_t shaded = 0;
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        const int covered = in(white.scissor, x, y) ? covered_samples(triangle, x, y, samples) : 0;
        partly_covered += covered != 0 && covered != samples;
        shaded += covered != 0;
        expected.push_back(0x010101u * mean_level(255 * covered, samples));
      }
    for (Renderer& renderer : renderers) {
      FrameBuffer buffer(format_of(samples));
      Frame frame(buffer);
      frame.draw(mesh.view(), white);
      ASSERT_EQ(renderer.finish(frame).shaded_pixels, shaded)
          << "triangle " << turn << ", tiles of " << renderer.options().tile_size;
      const std::vector<std::uint32_t> found = packed_colors(buffer);
      const auto differ = std::mismatch(found.begin(), found.end(), expected.begin());
      ASSERT_TRUE(differ.first == found.end())
          << "triangle " << turn << ", tiles of " << renderer.options().tile_size << ", pixel "
          << (differ.first - found.begin()) % kWidth << ", " << (differ.first - found.begin()) / kWidth
          << ": " << std::hex << *differ.first << ", not " << *differ.second;
    }
  }
  EXPECT_GE(partly_covered, samples > 1 ? 10000u : 0u);
}

// A sheet with random inner vertices is drawn with additive blending: samples covered twice or not at all
// change the colour.
TEST_P(FrameSamples, BelongToExactlyOneTriangleAtASharedEdge) {
  Renderer renderer({.threads = 1});
  Random random(32);
  constexpr int kColumns = 13;
  constexpr int kRows = 7;
  for (int turn = 0; turn < 25; ++turn) {
    MeshData mesh;
    for (int row = 0; row <= kRows; ++row)
      for (int column = 0; column <= kColumns; ++column) {
        const bool is_border = row == 0 || column == 0 || row == kRows || column == kColumns;
        const auto moved = [&](int at, int count, int size) {
          const std::int64_t even = std::int64_t{size + 32} * kScale * at / count - 16 * kScale;
          return even + (is_border ? 0 : below(random, 9 * kScale) - 4 * kScale);
        };
        const std::int64_t x = moved(column, kColumns, kWidth);
        add(mesh, {x, moved(row, kRows, kHeight)});
      }
    for (std::uint32_t row = 0; row < kRows; ++row)
      for (std::uint32_t column = 0; column < kColumns; ++column) {
        const std::uint32_t a = row * (kColumns + 1) + column;
        const std::uint32_t b = a + 1;
        const std::uint32_t c = a + kColumns + 1;
        const std::uint32_t d = c + 1;
        if (random.next() % 2 == 0) mesh.indices.insert(mesh.indices.end(), {a, b, c, b, c, d});
        else mesh.indices.insert(mesh.indices.end(), {a, b, d, a, d, c});
      }
    FrameBuffer buffer(format_of(samples));
    Frame frame(buffer);
    DrawState quarter = unlit({0.25f, 0.25f, 0.25f, 1});
    quarter.depth.enabled = false;
    quarter.blend = BlendState{.src = BlendFactor::one, .dst = BlendFactor::one};
    frame.draw(mesh.view(), quarter);
    renderer.finish(frame);
    const std::vector<std::uint32_t> words = packed_colors(buffer);
    ASSERT_EQ(std::count(words.begin(), words.end(), 0x404040u), std::ptrdiff_t{kWidth} * kHeight)
        << "sheet " << turn;
  }
}

TEST_P(FrameSamples, AreKeptUntilTheEndOfTheFrame) {
  Renderer renderer({.threads = 1});
  Random random(33);
  // Two triangles share the long edge. In one frame all their samples become white. In two frames the resolve
  // of the first one stores the edge in grey, and the second one starts from that grey.
  for (const bool in_one_frame : {true, false}) {
    for (int turn = 0; turn < 10; ++turn) {
      const Point a{below(random, 20 * kScale), below(random, kHeight * kScale)};
      const Point b{kWidth * kScale - below(random, 20 * kScale), below(random, kHeight * kScale)};
      const Triangle upper{a, b, Point{kWidth * kScale / 2, -200 * kScale}};
      const Triangle lower{a, b, Point{kWidth * kScale / 2, 300 * kScale}};
      const MeshData first = mesh_of(upper);
      const MeshData second = mesh_of(lower);
      FrameBuffer buffer(format_of(samples));
      Frame frame(buffer);
      DrawState white = unlit({1, 1, 1, 1});
      white.depth.enabled = false;
      frame.draw(first.view(), white);
      if (!in_one_frame) renderer.finish(frame);
      frame.draw(second.view(), white);
      renderer.finish(frame);
      const std::vector<std::uint32_t> words = packed_colors(buffer);
      for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
          const int in_first = covered_samples(upper, x, y, samples);
          const int in_second = covered_samples(lower, x, y, samples);
          const int resolved = static_cast<int>(mean_level(255 * in_first, samples));
          const int sum = in_one_frame ? 255 * (in_first + in_second)
                                       : 255 * in_second + resolved * (samples - in_second);
          const std::uint32_t expected = mean_level(sum, samples);
          ASSERT_EQ(words[static_cast<std::size_t>(y * kWidth + x)], 0x010101u * expected)
              << x << ", " << y << (in_one_frame ? " in one frame" : " in two frames");
        }
    }
  }
}

TEST_P(FrameSamples, StoredDepthAndStencilAreThoseOfSample0) {
  Renderer renderer({.threads = 1});
  Random random(34);
  for (int turn = 0; turn < 10; ++turn) {
    const Triangle triangle = random_triangle(random, 2);
    // Depth rises to the right and downwards: 0.25 + x / 1024 + y / 512, with x and y in pixels.
    MeshData mesh;
    const auto depth_at = [](const Point& p) {
      return 0.25 + static_cast<double>(p.x) / (1024.0 * kScale) +
             static_cast<double>(p.y) / (512.0 * kScale);
    };
    for (const Point& p : triangle) add(mesh, p, static_cast<float>(2 * depth_at(p) - 1));
    FrameBuffer buffer(format_of(samples));
    Frame frame(buffer);
    frame.clear({.depth = 1.0, .stencil = 3});
    DrawState state = unlit({1, 1, 1, 1});
    state.stencil = StencilState{.front = {.ref = 9, .zpass = StencilOp::replace}};
    frame.draw(mesh.view(), state);
    renderer.finish(frame);
    const std::vector<std::uint32_t> levels = stored_depths(buffer);
    const std::vector<std::uint8_t> stencil = stencil_values(buffer);
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        const std::size_t i = static_cast<std::size_t>(y * kWidth + x);
        const Point first = sample_of(x, y, pattern(samples).front());
        const bool covered = covers(triangle, first);
        ASSERT_EQ(stencil[i], covered ? 9 : 3) << x << ", " << y;
        const double level = covered ? std::floor(depth_at(first) * 0xffffff + 0.5) : 0xffffff;
        // From pixel to pixel the depth rises by 16384 levels or more.
        ASSERT_NEAR(levels[i], level, covered ? 2 : 0) << x << ", " << y;
      }
  }
}

INSTANTIATE_TEST_SUITE_P(Patterns, FrameSamples, testing::Values(1, 4, 8),
                         [](const auto& count) { return "Of" + std::to_string(count.param); });

TEST(FrameSamplesMemory, TakeNoMemoryBetweenFrames) {
  constexpr Buffer kBuffers[] = {Buffer::color, Buffer::depth, Buffer::stencil, Buffer::accumulation};
  Renderer renderer({.threads = 1});
  const MeshData triangle = mesh_of({Point{1000, 2000}, {40000, 5000}, {3000, 30000}});
  for (const int samples : {4, 8}) {
    FrameBufferFormat one = format_of(1);
    FrameBufferFormat several = format_of(samples);
    one.accumulation_bits = several.accumulation_bits = 16;
    EXPECT_EQ(FrameBuffer::memory_bytes(one), FrameBuffer::memory_bytes(several));
    FrameBuffer plain(one);
    FrameBuffer sampled(several);
    for (const Buffer which : kBuffers) {
      EXPECT_EQ(sampled.allocated_bytes(which), 0u) << static_cast<int>(which);
      EXPECT_EQ(sampled.plane_count(which), plain.plane_count(which)) << static_cast<int>(which);
    }
    for (FrameBuffer* buffer : {&plain, &sampled}) {
      Frame frame(*buffer);
      frame.clear({.depth = 1.0});
      frame.draw(triangle.view(), unlit({1, 1, 1, 1}));
      renderer.finish(frame);
    }
    for (const Buffer which : kBuffers)
      EXPECT_EQ(sampled.allocated_bytes(which), plain.allocated_bytes(which)) << static_cast<int>(which);
    EXPECT_GT(sampled.allocated_bytes(Buffer::color), 0u);
  }
}

}  // namespace
}  // namespace tessera::samples_test
