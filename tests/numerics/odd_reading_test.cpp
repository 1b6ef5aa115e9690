// Reading frame buffers with odd arguments: distances for any projection and background, planes of absent
// buffers. The result is an error that names the value found, or the distances of the formula.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "tests/engine/frame/api_support.h"
#include "tests/numerics/odd_values.h"

namespace tessera::test::odd_reading_test {
namespace {

using Real = long double;
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kDepths[] = {0, 0x1p-140, 1e-9, 0.1, 0.25, 0.5, 0.75, 0.9999, 1};
constexpr int kColumns = static_cast<int>(std::size(kDepths));

/// A buffer that stores each depth in its own pixel.
struct Depths {
  FrameBuffer buffer;
  std::vector<Real> stored;

  explicit Depths(DepthFormat format) : buffer({.width = kColumns, .height = 1, .depth = format}) {
    Frame frame(buffer);
    for (int i = 0; i < kColumns; ++i) frame.clear({.depth = kDepths[i], .scissor = Rect{i, 0, 1, 1}});
    Renderer({.threads = 1}).finish(frame);
    std::vector<std::uint32_t> words(kColumns);
    buffer.read_stored_depths(words);
    for (const std::uint32_t word : words)
      stored.push_back(format == DepthFormat::float32 ? Real{std::bit_cast<float>(word)}
                                                      : word / Real{0xffffff});
  }
  std::vector<float> distances(const Camera& camera, float background = -1) const {
    std::vector<float> all(kColumns, 7.0f);
    buffer.read_view_depth(all, camera, background);
    return all;
  }
};

std::vector<Camera> cameras() {
  return {{.projection = perspective(47, 1.3, 0.1, 77)},
          {.projection = perspective(47, 1.3, 0.1, kInfinity)},
          {.projection = perspective(47, 1.3, 0.1, 77, true), .reversed = true},
          {.projection = perspective(47, 1.3, 0.1, kInfinity, true), .reversed = true},
          {.projection = orthographic(-1, 3, -2, 2, -2, 33)},
          {.projection = orthographic(-1, 3, -2, 2, -2, 33, true), .reversed = true}};
}

// The eye-space z solves (a z + b) / (c z + e) = depth; the distance is -z. Products and differences are
// computed in double.
void expect_distances(const Depths& depths, const Camera& camera, const std::vector<float>& found,
                      const std::string& where) {
  const auto& m = camera.projection.m;
  const Real a = m[10];
  const Real b = m[11];
  const Real c = m[14];
  const Real e = m[15];
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (depths.stored[i] == (camera.reversed ? 0 : 1)) {
      EXPECT_EQ(found[i], -1) << where;
      continue;
    }
    ASSERT_FALSE(std::isnan(found[i])) << where;
    const Real z = camera.reversed ? depths.stored[i] : 2 * depths.stored[i] - 1;
    const Real over = e * z - b;
    const Real under = c * z - a;
    const Real over_off = 0x1p-51L * (std::abs(e) + std::abs(b));
    const Real under_off = 0x1p-51L * (std::abs(c) + std::abs(a));
    if (!(std::abs(under) > 2 * under_off)) continue;  // within rounding of infinity
    const Real exact = over / under;
    const Real off = 0x1p-24L * std::abs(exact) +
                     2 * (over_off + std::abs(exact) * under_off) / std::abs(under) + 0x1p-149L;
    if (std::abs(exact) + off > 0x1p127L) continue;  // near the largest float, or beyond
    EXPECT_LE(std::abs(found[i] - exact), off) << where << ", depth " << depths.stored[i];
  }
}

// Matrix elements that do not affect depth may be any finite numbers; those of x and y in depth must be 0.
TEST(OddReading, DistancesUnderOddProjectionsAreErrorsOrMatchTheFormula) {
  const std::vector<double> odd = odd_values<double>();
  std::size_t read = 0;
  std::size_t refused = 0;
  std::size_t turn = 0;
  for (const DepthFormat format : {DepthFormat::unorm24, DepthFormat::float32}) {
    const Depths depths(format);
    for (const Camera& plain : cameras()) {
      ++turn;  // other pairs in each case
      for (std::size_t i = 0; i < 16; ++i)
        for (std::size_t j = i; j < 16; ++j)
          for (const double first : odd) {
            Camera camera = plain;
            camera.projection.m[i] = first;
            camera.projection.m[j] = j == i ? first : odd[(i + 3 * j + turn++) % odd.size()];
            const auto& m = camera.projection.m;
            const bool finite = std::all_of(m.begin(), m.end(), [](double v) { return std::isfinite(v); });
            const bool straight = m[8] == 0 && m[9] == 0 && m[12] == 0 && m[13] == 0;
            std::optional<std::vector<float>> found;
            const std::string message = error_of([&] { found = depths.distances(camera); }).value_or("");
            const std::string where = "elements " + std::to_string(i) + " and " + std::to_string(j) + ": " +
                                      std::to_string(m[i]) + ", " + std::to_string(m[j]);
            if (!found) {
              ++refused;
              const Real ae = Real{m[10]} * m[15];
              const Real bc = Real{m[11]} * m[14];
              const bool alike = std::abs(ae - bc) <= 0x1p-49L * (std::abs(ae) + std::abs(bc));
              // Products of numbers 2^1000 times smaller than the largest are 0.
              const Real largest =
                  std::max({std::abs(m[10]), std::abs(m[11]), std::abs(m[14]), std::abs(m[15])});
              const bool is_null = std::abs(ae - bc) < 0x1p-1000L * largest * largest;
              const bool is_singular = alike || is_null;
              EXPECT_TRUE(!finite || !straight || is_singular) << where << ": " << message;
              EXPECT_THAT(message, testing::StartsWith("FrameBuffer::read_view_depth: projection")) << where;
              continue;
            }
            ++read;
            ASSERT_TRUE(finite && straight) << where;
            expect_distances(depths, camera, *found, where);
            if (HasFatalFailure()) return;
          }
    }
  }
  EXPECT_GT(read, 10000u);
  EXPECT_GT(refused, 10000u);
}

TEST(OddReading, ProjectionsWithoutDepthAreErrors) {
  const Depths depths(DepthFormat::unorm24);
  const auto error = [&](double a, double b, double c, double e) {
    Camera camera;
    camera.projection.m[10] = a;
    camera.projection.m[11] = b;
    camera.projection.m[14] = c;
    camera.projection.m[15] = e;
    return error_of([&] { depths.distances(camera); }).value_or("");
  };
  EXPECT_EQ(error(0, 0, 0, 0),
            "FrameBuffer::read_view_depth: projection's rows of z and w are 0, 0, 0, 0 and 0, 0, 0, 0, they "
            "must not be multiples of each other, or all depths are the same");
  EXPECT_THAT(error(2, 4, 1, 2), testing::HasSubstr("0, 0, 2, 4 and 0, 0, 1, 2"));
  EXPECT_THAT(error(0, 0, 0, 1), testing::HasSubstr("multiples"));
  EXPECT_THAT(error(1.1, 2.2, 3.3 * (1 + 0x1p-52), 6.6), testing::HasSubstr("multiples"));
  EXPECT_EQ(error(1, 0, 0, 1), "");
  Camera oblique{.projection = perspective(47, 1.3, 0.1, 77)};
  oblique.projection.m[8] = 0.25;
  EXPECT_THAT(error_of([&] { depths.distances(oblique); }).value_or(""), testing::HasSubstr("0.25, 0,"));
}

// A projection can be scaled; the view does not matter; the background is returned bit for bit.
TEST(OddReading, DistancesDependOnNothingElse) {
  for (const DepthFormat format : {DepthFormat::unorm24, DepthFormat::float32}) {
    const Depths depths(format);
    for (const Camera& plain : cameras()) {
      const std::vector<float> expected = depths.distances(plain);
      for (const int exponent : {-900, -1, 1, 1000}) {
        Camera scaled = plain;
        for (double& element : scaled.projection.m) element = std::ldexp(element, exponent);
        EXPECT_EQ(depths.distances(scaled), expected) << exponent;
      }
      for (const double odd : odd_values<double>()) {
        Camera camera = plain;
        camera.view.m.fill(odd);
        EXPECT_EQ(depths.distances(camera), expected) << odd;
      }
      for (const float background : odd_values<float>()) {
        const std::vector<float> found = depths.distances(plain, background);
        for (std::size_t i = 0; i < found.size(); ++i)
          EXPECT_EQ(std::bit_cast<std::uint32_t>(found[i]),
                    std::bit_cast<std::uint32_t>(expected[i] == -1 ? background : expected[i]));
      }
    }
  }
}

TEST(OddReading, InvalidBuffersHaveNoPlanes) {
  FrameBuffer buffer({.width = 40, .height = 30, .accumulation_bits = 16});
  for (const Buffer which : {Buffer::color, Buffer::depth, Buffer::stencil, Buffer::accumulation}) {
    buffer.plane(which, 0);
    EXPECT_GT(buffer.plane_count(which), 0);
    EXPECT_GT(buffer.allocated_bytes(which), 0u);
  }
  for (const int odd : {4, 5, 127, 255}) {
    const auto which = static_cast<Buffer>(odd);
    EXPECT_EQ(buffer.plane_count(which), 0) << odd;
    EXPECT_EQ(buffer.allocated_bytes(which), 0u) << odd;
    for (const int k : odd_values<int>())
      EXPECT_THAT(error_of([&] { buffer.plane(which, k); }).value_or(""),
                  testing::HasSubstr("buffer is " + std::to_string(odd)))
          << k;
  }
  for (const int k : odd_values<int>())
    EXPECT_EQ(error_of([&] { buffer.plane(Buffer::stencil, k); }).has_value(), k < 0 || k > 7) << k;
}

}  // namespace
}  // namespace tessera::test::odd_reading_test
