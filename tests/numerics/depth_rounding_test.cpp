// How depths are rounded to each format: of clears and bitmaps at every kind of double, of polygons that are parallel to the screen, in exact numbers.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <limits>
#include <string>

#include "tests/numerics/exact.h"
#include "tests/engine/api_support.h"
#include "tests/raster/random_triangles.h"

namespace tessera::test {
namespace {

constexpr DepthFormat kUnorms[] = {DepthFormat::unorm16, DepthFormat::unorm24, DepthFormat::unorm32};
int bits_of(DepthFormat format) { return format == DepthFormat::unorm16 ? 16 : format == DepthFormat::unorm24 ? 24 : 32; }

/// floor(z (2^b - 1) + 1/2), or the nearest float. @pre z is 0, or above 2^-47
std::uint32_t expected_word(DepthFormat format, double z) {
  if (format == DepthFormat::float32) return std::bit_cast<std::uint32_t>(std::abs(static_cast<float>(z)));
  return static_cast<std::uint32_t>((Ratio::of(z) * ((std::int64_t{1} << bits_of(format)) - 1)).rounded());
}

/// Levels, the middles between them, and what is next to both; ends, and any others.
std::vector<double> telling_depths(DepthFormat format, Random& random, int count) {
  std::vector<double> depths{0, -0.0, 1, 0.5, std::nextafter(1.0, 0.0), 0x1p-40, 0x1p-33, std::nextafter(0x1p-33, 0.0), std::nextafter(0x1p-33, 1.0)};
  const int bits = format == DepthFormat::float32 ? 24 : bits_of(format);
  const double levels = std::ldexp(1.0, bits) - 1;
  for (int i = 0; i < count; ++i) {
    const double level = i < 40 ? i : i < 80 ? levels - (i - 40) : std::floor((random.next() + random.next() * 0x1p-32) * 0x1p-32 * levels), half = i % 2 == 0 ? 0.5 : 0.0;
    const double at = std::min((level + half) / levels, 1.0);
    for (const double z : {std::nextafter(at, 0.0), at, std::nextafter(at, 2.0)}) depths.push_back(std::min(z, 1.0));
  }
  return depths;
}

using Put = std::function<void(Frame&, Rect, double)>;

void expect_exact(DepthFormat format, const char* what, const std::vector<double>& depths, const Put& put) {
  constexpr int kRow = 1024;
  Renderer renderer({.threads = 1});
  const int height = static_cast<int>((depths.size() + kRow - 1) / kRow);
  FrameBuffer buffer({.width = kRow, .height = height, .depth = format});
  Frame frame(buffer);
  for (std::size_t i = 0; i < depths.size(); ++i) put(frame, {static_cast<int>(i % kRow), height - 1 - static_cast<int>(i / kRow), 1, 1}, depths[i]);
  renderer.finish(frame);
  const auto words = depth_words(buffer);
  int wrong = 0;
  for (std::size_t i = 0; i < depths.size(); ++i)
    if (words[i] != expected_word(format, depths[i]) && wrong++ < 3) ADD_FAILURE() << what << ": " << std::hexfloat << depths[i] << " is " << words[i] << ", not " << expected_word(format, depths[i]) << ", in format " << static_cast<int>(format);
  EXPECT_EQ(wrong, 0) << what << ", format " << static_cast<int>(format);
}

TEST(DepthRounding, OfClearsAndBitmapsIsExact) {
  Random random(1);
  for (const DepthFormat format : {DepthFormat::unorm16, DepthFormat::unorm24, DepthFormat::unorm32, DepthFormat::float32}) {
    const std::vector<double> depths = telling_depths(format, random, long_tests() ? 100000 : 2000);
    expect_exact(format, "clears", depths, [](Frame& frame, Rect at, double z) { frame.clear({.depth = z, .scissor = at}); });
    expect_exact(format, "bitmaps", depths, [](Frame& frame, Rect at, double z) {
      static const std::uint8_t bit = 0x80;
      frame.draw_bitmap({.bits = &bit, .width = 1, .height = 1, .x = static_cast<double>(at.x), .y = static_cast<double>(at.y), .depth = z}, {.depth = {.test = Compare::always}});
    });
  }
}

// A polygon's clip z is a float, and 0.5 z + 0.5 of it is a double, exactly; reversed it is z itself. Whole triangles have that one level: small and large ones, points
// and lines, on each instruction set and with several samples, whatever clipping does to them.
TEST(DepthRounding, OfPolygonsParallelToTheScreenIsExact) {
  constexpr int kWidth = 96, kHeight = 64, kCell = 8, kCells = kWidth / kCell * (kHeight / kCell);
  for (const DepthFormat format : {DepthFormat::unorm16, DepthFormat::unorm24, DepthFormat::unorm32, DepthFormat::float32}) {
    Random random(2);
    std::vector<float> telling;
    for (const bool reversed : {false, true})
      for (const InstructionSet set : available_instruction_sets())
        for (const int samples : {1, 8}) {
          telling.clear();
          for (const double z : telling_depths(format, random, long_tests() ? 5000 : 300)) {
            const float at = static_cast<float>(reversed ? z : 2 * z - 1), low = reversed ? 0.0f : -1.0f;
            for (const float f : {std::nextafter(at, low), at, std::nextafter(at, 1.0f)})
              if (reversed ? f == 0 || f > 0x1p-30f : std::abs(f) > 0x1p-28f) telling.push_back(f);
          }
          Renderer renderer({.threads = 1, .instruction_set = set});
          FrameBuffer buffer({.width = kWidth, .height = kHeight, .depth = format, .samples = samples});
          for (std::size_t first = 0; first < telling.size(); first += kCells) {
            Frame frame(buffer);
            frame.set_camera({.reversed = reversed});
            std::vector<MeshData> meshes;
            const std::size_t count = std::min<std::size_t>(kCells, telling.size() - first);
            for (std::size_t i = 0; i < count; ++i) {
              const float size = i % 3 == 0 ? 1.0f : i % 3 == 1 ? 1000.0f : 1e6f;  // of the viewport's half; the largest are clipped
              meshes.push_back(i % 5 == 4 ? MeshData{} : rectangle(-size, -size, size, size, telling[first + i]));
              if (i % 5 == 4) {
                meshes.back().primitive = i % 2 == 0 ? Primitive::points : Primitive::lines;
                meshes.back().positions = {0, 0, telling[first + i]};
                if (i % 2 != 0) meshes.back().positions = {-2, 0, telling[first + i], 2, 0, telling[first + i]};
              }
            }
            for (std::size_t i = 0; i < count; ++i) {
              DrawState state;
              state.depth.test = Compare::always;
              state.viewport = state.scissor = Rect{static_cast<int>(i) % (kWidth / kCell) * kCell, static_cast<int>(i) / (kWidth / kCell) * kCell, kCell, kCell};
              state.point_size = state.line_width = 4 * kCell;
              frame.draw(meshes[i].view(), state);
            }
            renderer.finish(frame);
            const auto words = depth_words(buffer);
            for (int y = 0; y < kHeight; ++y)
              for (int x = 0; x < kWidth; ++x) {
                const std::size_t cell = static_cast<std::size_t>((kHeight - 1 - y) / kCell * (kWidth / kCell) + x / kCell);
                if (cell >= count) continue;
                const double z = telling[first + cell], depth = reversed ? z : 0.5 * z + 0.5;
                ASSERT_EQ(words[static_cast<std::size_t>(y * kWidth + x)], expected_word(format, depth))
                    << std::hexfloat << z << (reversed ? " reversed" : "") << ", format " << static_cast<int>(format) << ", " << samples << " samples, cell " << cell << " at " << x << ", " << y << ", on " << name(set);
              }
          }
        }
  }
}

}  // namespace
}  // namespace tessera::test
