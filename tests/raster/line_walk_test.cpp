// LineWalk against a literal implementation of the diamond-exit rule.
#include <gtest/gtest.h>

#include <random>
#include <set>
#include <string>
#include <vector>

#include "raster/line_walk.h"
#include "tests/raster/diamond_exit_rule.h"
#include "tests/raster/random_triangles.h"

namespace tessera::test::line_walk_test {
using namespace detail;
namespace {

struct Random {
  std::mt19937 bits;
  explicit Random(unsigned seed) : bits(seed) {}
  int between(int low, int high) {
    return low + static_cast<int>(bits() % static_cast<unsigned>(high - low + 1));
  }
};

using Pixels = std::vector<std::pair<int, int>>;
constexpr PixelRect kEverywhere{-40000, -40000, 40000, 40000};
Pixels walked(const LinePoint& a, const LinePoint& b, int width = 1, const PixelRect& rect = kEverywhere) {
  Pixels pixels;
  LineWalk(a, b, width).for_each(rect, [&](int x, int y) { pixels.push_back({x, y}); });
  return pixels;
}
std::string text(const LinePoint& a, const LinePoint& b) {
  return std::to_string(a.x) + " " + std::to_string(a.y) + " to " + std::to_string(b.x) + " " +
         std::to_string(b.y);
}
void expect_diamond_exit_pixels(const LinePoint& a, const LinePoint& b) {
  const Pixels found = walked(a, b);
  const std::set<std::pair<int, int>> distinct(found.begin(), found.end());
  ASSERT_EQ(distinct.size(), found.size()) << text(a, b) << ": a pixel occurs twice";
  ASSERT_EQ(distinct, diamond_exit_pixels(a, b)) << text(a, b);
}

TEST(LineWalk, FollowsDiamondExitRuleAnywhere) {
  Random random(1);
  const int lines = long_tests() ? 1000000 : 30000;
  for (int i = 0; i < lines; ++i) {
    constexpr int kReaches[] = {300, 1500, 5000};
    const int reach = kReaches[i % 3];
    const LinePoint a{random.between(-2000, 2000), random.between(-2000, 2000)};
    expect_diamond_exit_pixels(a, {a.x + random.between(-reach, reach), a.y + random.between(-reach, reach)});
    if (HasFatalFailure()) return;
  }
}

// Ends on multiples of an eighth, a quarter or half of a pixel, which hit corners, sides and centres of
// diamonds.
TEST(LineWalk, FollowsDiamondExitRuleOnBorders) {
  for (const int grid : {32, 64, 128}) {
    const int n = 256 / grid;
    for (int ay = 0; ay < n; ++ay)
      for (int ax = 0; ax < n; ++ax)
        for (int by = -n - 2; by <= 2 * n + 2; ++by)
          for (int bx = -n - 2; bx <= 2 * n + 2; ++bx) {
            expect_diamond_exit_pixels({ax * grid, ay * grid}, {bx * grid, by * grid});
            if (HasFatalFailure()) return;
          }
  }
}

TEST(LineWalk, ZeroLengthLineIsEmpty) {
  for (int y = 0; y < 256; y += 32)
    for (int x = 0; x < 256; x += 32) EXPECT_TRUE(walked({x, y}, {x, y}).empty());
}

TEST(LineWalk, VisitsPixelsFromStartToEnd) {
  Random random(2);
  for (int i = 0; i < 3000; ++i) {
    const LinePoint a{random.between(-5000, 5000), random.between(-5000, 5000)};
    const LinePoint b{random.between(-5000, 5000), random.between(-5000, 5000)};
    const Pixels pixels = walked(a, b);
    for (std::size_t k = 1; k < pixels.size(); ++k) {  // connected, and each pixel closer to the end
      ASSERT_LE(std::abs(pixels[k].first - pixels[k - 1].first), 1) << text(a, b);
      ASSERT_LE(std::abs(pixels[k].second - pixels[k - 1].second), 1) << text(a, b);
      const auto along = [&](const std::pair<int, int>& p) {
        return std::int64_t{p.first} * (b.x - a.x) + std::int64_t{p.second} * (b.y - a.y);
      };
      ASSERT_GT(along(pixels[k]), along(pixels[k - 1])) << text(a, b);
    }
  }
}

TEST(LineWalk, TilesReproduceTheWholeLine) {
  Random random(3);
  for (int i = 0; i < 3000; ++i) {
    const LinePoint a{random.between(-20000, 20000), random.between(-20000, 20000)};
    const LinePoint b{random.between(-20000, 20000), random.between(-20000, 20000)};
    const int width = i % 4 == 0 ? random.between(2, 9) : 1;
    std::set<std::pair<int, int>> whole_line, in_parts;
    for (const auto& p : walked(a, b, width)) whole_line.insert(p);
    std::size_t count = 0;
    for (int y = -96; y < 96; y += 32)
      for (int x = -96; x < 96; x += 32)
        for (const auto& p : walked(a, b, width, {x, y, x + 32, y + 32})) in_parts.insert(p), ++count;
    ASSERT_EQ(in_parts, whole_line) << text(a, b);
    ASSERT_EQ(count, whole_line.size()) << text(a, b);
  }
}

// Strips whose segments stay in one octant have no gaps and no duplicate pixels.
TEST(LineWalk, JointsInOneOctantHaveNoGapsOrDuplicates) {
  Random random(4);
  const int strips = long_tests() ? 200000 : 5000;
  for (int i = 0; i < strips; ++i) {
    const int octant = i % 8;
    LinePoint at{random.between(-500, 500), random.between(-500, 500)};
    Pixels pixels;
    for (int segment = 0; segment < 6; ++segment) {
      const int along = random.between(1, 900), across = random.between(0, along - 1);
      const int x = (octant & 1) != 0 ? along : across, y = (octant & 1) != 0 ? across : along;
      const LinePoint next{at.x + ((octant & 2) != 0 ? x : -x), at.y + ((octant & 4) != 0 ? y : -y)};
      for (const auto& p : walked(at, next)) pixels.push_back(p);
      at = next;
    }
    for (std::size_t k = 1; k < pixels.size(); ++k) {
      const int dx = std::abs(pixels[k].first - pixels[k - 1].first);
      const int dy = std::abs(pixels[k].second - pixels[k - 1].second);
      ASSERT_EQ(std::max(dx, dy), 1) << "octant " << octant << ", strip " << i << ": " << pixels[k - 1].first
                                     << " " << pixels[k - 1].second << " then " << pixels[k].first << " "
                                     << pixels[k].second;
    }
  }
}

TEST(LineWalk, WideLinesRepeatPixelsAlongMinorAxis) {
  Random random(5);
  for (int i = 0; i < 2000; ++i) {
    const LinePoint a{random.between(-4000, 4000), random.between(-4000, 4000)};
    const LinePoint b{random.between(-4000, 4000), random.between(-4000, 4000)};
    const int width = random.between(2, 8);
    const bool x_major = std::abs(b.x - a.x) >= std::abs(b.y - a.y);
    // The line is moved by -(w - 1) / 2 along its minor axis (y up), and each fragment is repeated w times
    // from there.
    const int aside = 128 * (width - 1);
    const LinePoint from{a.x - (x_major ? 0 : aside), a.y + (x_major ? aside : 0)};
    const LinePoint to{b.x - (x_major ? 0 : aside), b.y + (x_major ? aside : 0)};
    std::set<std::pair<int, int>> expected;
    for (const auto& [x, y] : diamond_exit_pixels(from, to))
      for (int k = 0; k < width; ++k) expected.insert({x_major ? x : x + k, x_major ? y - k : y});
    const Pixels found = walked(a, b, width);
    ASSERT_EQ(std::set(found.begin(), found.end()), expected) << text(a, b) << ", width " << width;
    ASSERT_EQ(found.size(), expected.size());
  }
}

}  // namespace
}  // namespace tessera::test::line_walk_test
