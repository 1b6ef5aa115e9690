// Thousands of points and lines in one draw (a million of each in the long tests): every pixel is compared
// with the rules in exact integers. Many are partly outside the window; many lines are cut at the near or far
// plane.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "tests/engine/frame/api_support.h"
#include "tests/raster/diamond_exit_rule.h"
#include "tests/raster/random_triangles.h"

namespace tessera::many_points_lines_test {
namespace {

using namespace test;

// Powers of two: every multiple of 1/256 pixel is exact in a float's window coordinate.
constexpr int kWidth = 1024;
constexpr int kHeight = 512;

/// A mesh and the pixels of each of its elements.
struct Elements {
  MeshData mesh;
  std::vector<std::uint32_t> words;
  std::vector<std::vector<std::pair<int, int>>> pixels;

  explicit Elements(Primitive primitive) { mesh.primitive = primitive; }
  void add(const LinePoint& p, float z, std::uint32_t word) {
    for (const float c :
         {static_cast<float>(p.x) / (128 * kWidth) - 1, 1 - static_cast<float>(p.y) / (128 * kHeight), z})
      mesh.positions.push_back(c);
    for (int c = 2; c >= 0; --c) mesh.colors.push_back(static_cast<float>(word >> (8 * c) & 255) / 255.0f);
    mesh.colors.push_back(1);
  }
};

std::int32_t int_below(Random& random, std::int32_t n) { return static_cast<std::int32_t>(below(random, n)); }
std::int32_t about(Random& random, std::int32_t n) { return int_below(random, 2 * n + 1) - n; }
LinePoint somewhere(Random& random) {
  return {int_below(random, (kWidth + 64) * 256) - 32 * 256,
          int_below(random, (kHeight + 64) * 256) - 32 * 256};
}
int count() { return long_tests() ? 1'000'000 : 20'000; }

// Squares of 3 pixels around the pixel that holds the point. Some points lie in front of the near plane or
// behind the far plane.
Elements random_points(std::uint64_t seed) {
  Random random(seed);
  Elements points(Primitive::points);
  for (int i = 0; i < count(); ++i) {
    LinePoint p = somewhere(random);
    if (i % 3 == 0) p = {p.x & ~127, p.y & ~127};  // pixel centres, borders and corners
    const std::uint32_t word = random.next() & 0xffffff;
    const float z = i % 8 == 0 ? random.between(-2, 2) : 0;
    points.add(p, z, word);
    points.words.push_back(word);
    // A point on a border belongs to the pixel to the right or above; the view volume includes its border.
    const bool is_in_view =
        z >= -1 && z <= 1 && p.x >= 0 && p.x <= kWidth * 256 && p.y >= 0 && p.y <= kHeight * 256;
    std::vector<std::pair<int, int>> pixels;
    for (int y = -1; y <= 1 && is_in_view; ++y)
      for (int x = -1; x <= 1; ++x) pixels.push_back({(p.x >> 8) + x, ((p.y - 1) >> 8) + y});
    points.pixels.push_back(pixels);
  }
  return points;
}

// A quarter of the lines ends outside the near or far plane and is cut at a quarter, half or three quarters
// of its length, which is a whole multiple of 1/256 pixel.
Elements random_lines(std::uint64_t seed) {
  Random random(seed);
  Elements lines(Primitive::lines);
  for (int i = 0; i < count(); ++i) {
    LinePoint a = somewhere(random);
    if (i % 3 == 0) a = {a.x & ~127, a.y & ~127};
    const int unit = i % 3 == 1 ? 128 : 4;
    const int reach = (i % 16 == 0 ? 40 : 8) * 256 / unit;
    LinePoint b{a.x + unit * about(random, reach), a.y + unit * about(random, reach)};
    const std::uint32_t word = random.next() & 0xffffff;
    LinePoint from = a;
    LinePoint to = b;
    float z[2] = {0, 0};
    if (i % 4 == 0) {
      // From distance 1 inside the plane to 1, 3 or 1/3 outside.
      static constexpr float kOuterDepth[] = {0, 4.0f, 2.0f, 1.25f};  // by quarters
      const int quarters = 1 + int_below(random, 3);
      const int end = int_below(random, 2);
      const int side = int_below(random, 2) != 0 ? 1 : -1;
      z[end] = static_cast<float>(side) * kOuterDepth[quarters];
      z[1 - end] = quarters == 3 ? static_cast<float>(side) * 0.25f : 0.0f;
      const LinePoint inner = end == 1 ? a : b;
      const LinePoint outer = end == 1 ? b : a;
      const LinePoint cut{inner.x + (outer.x - inner.x) / 4 * quarters,
                          inner.y + (outer.y - inner.y) / 4 * quarters};
      (end == 1 ? to : from) = cut;
    }
    lines.add(a, z[0], word ^ 0xffffff);
    lines.add(b, z[1], word);
    lines.words.push_back(word);
    const auto pixels = diamond_exit_pixels(from, to);
    lines.pixels.emplace_back(pixels.begin(), pixels.end());
  }
  return lines;
}

std::vector<std::uint32_t> drawn(const Elements& elements, const DrawState& state) {
  FrameBuffer buffer({.width = kWidth, .height = kHeight});
  Frame frame(buffer);
  frame.draw(elements.mesh.view(), state);
  Renderer({.threads = 2}).finish(frame);
  return packed_colors(buffer);
}
template <class Store>
std::vector<std::uint32_t> by_the_rules(const Elements& elements, const Store& store) {
  std::vector<std::uint32_t> words(std::size_t{kWidth} * kHeight);
  for (std::size_t i = 0; i < elements.words.size(); ++i)
    for (const auto& [x, y] : elements.pixels[i])
      if (x >= 0 && x < kWidth && y >= 0 && y < kHeight)
        store(words[static_cast<std::size_t>(y * kWidth + x)], elements.words[i]);
  return words;
}
std::size_t differing(const std::vector<std::uint32_t>& a, const std::vector<std::uint32_t>& b) {
  std::size_t n = 0;
  for (std::size_t i = 0; i < a.size(); ++i) n += a[i] != b[i];
  return n;
}

// Stored colours show the last element of a pixel; an exclusive or shows every missing or extra one.
void expect_by_the_rules(const Elements& elements) {
  DrawState state;
  state.lighting = false;
  state.shading = Shading::flat;
  state.depth.enabled = false;
  state.point_size = 3;
  EXPECT_EQ(
      differing(drawn(elements, state),
                by_the_rules(elements, [](std::uint32_t& stored, std::uint32_t word) { stored = word; })),
      0u);
  state.logic_op = LogicOp::bit_xor;
  EXPECT_EQ(
      differing(drawn(elements, state),
                by_the_rules(elements, [](std::uint32_t& stored, std::uint32_t word) { stored ^= word; })),
      0u);
}

TEST(ManyPoints, CoverPixelsByTheRule) { expect_by_the_rules(random_points(71)); }
TEST(ManyLines, CoverPixelsByTheRule) { expect_by_the_rules(random_lines(72)); }

}  // namespace
}  // namespace tessera::many_points_lines_test
