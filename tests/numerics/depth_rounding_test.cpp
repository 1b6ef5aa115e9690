// Rounding of depths to each format: clears and bitmaps with all kinds of doubles, against exact numbers; and
// a polygon parallel to the screen stores exactly the level of a clear to its depth.
//
// The bound: floor(z (2^b - 1) + 0.5) in double rounds the product and the sum, both up to 2^b, by 2^(b - 54)
// each. So next to the middle between two levels the farther level may be stored, by less than 2^(b - 53) of
// a level; e.g. 0.3, which as a double is less than 3/10, stores the level of 3/10. Everywhere else the
// nearest level is stored, and for float32 the nearest float.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <string>

#include "raster/vertex_transform.h"
#include "tests/engine/frame/api_support.h"
#include "tests/numerics/bounds.h"
#include "tests/numerics/exact.h"
#include "tests/raster/random_triangles.h"

namespace tessera::test::depth_rounding_test {
using namespace detail;
namespace {

constexpr DepthFormat kFormats[] = {DepthFormat::unorm16, DepthFormat::unorm24, DepthFormat::unorm32,
                                    DepthFormat::float32};
int bits_of(DepthFormat format) {
  if (format == DepthFormat::unorm16) return 16;
  return format == DepthFormat::unorm24 ? 24 : 32;
}
std::string name_of(DepthFormat format) {
  return format == DepthFormat::float32 ? "float" : std::to_string(bits_of(format)) + " bits";
}

long double beyond_half(DepthFormat format) {
  return format == DepthFormat::float32 ? 0 : std::ldexp(1.0L, bits_of(format) - 53);
}

/// Distance of a stored depth from the exact one beyond half a level, in levels. For float32: 0 for the
/// nearest float, 1 for any other.
/// @pre z is 0 or above 2^-47
long double beyond(DepthFormat format, double z, std::uint32_t word) {
  if (format == DepthFormat::float32)
    return word == std::bit_cast<std::uint32_t>(std::abs(static_cast<float>(z))) ? 0 : 1;
  return (Ratio::of(z) * ((std::int64_t{1} << bits_of(format)) - 1)).distance(word) - 0.5L;
}

/// Levels, the middles between them and their neighbours, the ends of the range, and decimal fractions.
std::vector<double> telling_depths(DepthFormat format, Random& random, int count) {
  std::vector<double> depths{0,
                             -0.0,
                             1,
                             0.5,
                             std::nextafter(1.0, 0.0),
                             0x1p-40,
                             0x1p-33,
                             std::nextafter(0x1p-33, 0.0),
                             std::nextafter(0x1p-33, 1.0)};
  for (int i = 0; i <= 100; ++i) depths.push_back(i / 100.0);
  const double levels = std::ldexp(1.0, format == DepthFormat::float32 ? 24 : bits_of(format)) - 1;
  for (int i = 0; i < count; ++i) {
    double level = i;
    if (i >= 40) level = levels - (i - 40);
    if (i >= 80) level = std::floor((random.next() + random.next() * 0x1p-32) * 0x1p-32 * levels);
    const double half = i % 2 == 0 ? 0.5 : 0.0;
    const double at = std::min((level + half) / levels, 1.0);
    for (const double z : {std::nextafter(at, 0.0), at, at == 0 ? 0x1p-46 : std::nextafter(at, 2.0)})
      depths.push_back(std::min(z, 1.0));
  }
  return depths;
}

using Put = std::function<void(Frame&, Rect, double)>;

std::vector<std::uint32_t> words_of(DepthFormat format, const std::vector<double>& depths, const Put& put) {
  constexpr int kRow = 1024;
  const int height = static_cast<int>((depths.size() + kRow - 1) / kRow);
  FrameBuffer buffer({.width = kRow, .height = height, .depth = format});
  Frame frame(buffer);
  for (std::size_t i = 0; i < depths.size(); ++i)
    put(frame, {static_cast<int>(i % kRow), height - 1 - static_cast<int>(i / kRow), 1, 1}, depths[i]);
  Renderer({.threads = 1}).finish(frame);
  std::vector<std::uint32_t> words = stored_depths(buffer);
  words.resize(depths.size());
  return words;
}
void clear_to(Frame& frame, Rect at, double z) { frame.clear({.depth = z, .scissor = at}); }

TEST(DepthRounding, RoundsClearsAndBitmapsToTheNearestLevel) {
  Random random(1);
  for (const DepthFormat format : kFormats) {
    const std::vector<double> depths = telling_depths(format, random, long_tests() ? 100000 : 2000);
    const auto clears = words_of(format, depths, clear_to);
    const auto bitmaps = words_of(format, depths, [](Frame& frame, Rect at, double z) {
      static const std::uint8_t bit = 0x80;
      frame.draw_bitmap({.bits = &bit,
                         .width = 1,
                         .height = 1,
                         .x = static_cast<double>(at.x),
                         .y = static_cast<double>(at.y),
                         .depth = z},
                        {.depth = {.test = Compare::always}});
    });
    EXPECT_TRUE(bitmaps == clears) << name_of(format);
    long double worst = 0;
    for (std::size_t i = 0; i < depths.size(); ++i) update_worst(worst, beyond(format, depths[i], clears[i]));
    expect_within("depth of clears, " + name_of(format) + ", beyond half a level", worst, beyond_half(format),
                  "levels");
  }
}

// A vertex stored as the middle of a level stays exactly there, also after being moved by one level, despite
// the roundings in between.
TEST(DepthRounding, KeepsVerticesInTheMiddleOfLevels) {
  Random random(2);
  for (const int bits : {16, 24}) {
    const std::uint32_t levels = (1u << bits) - 1;
    VertexTransform t;
    t.reversed = true;  // z is the depth
    t.depth = bits == 16 ? DepthFormat::unorm16 : DepthFormat::unorm24;
    t.half_width = t.half_height = t.guard_x = t.guard_y = 32;
    const double rows[] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1.0 / levels, 1.0 / levels, 0, 0, 0, 1};
    std::copy(std::begin(rows), std::end(rows), t.clip_from_object);
    t.set_error_bounds();
    for (std::uint32_t n = 0; n < 65535; ++n) {
      const std::uint32_t level = bits == 16 ? n : random.next() % levels;
      const float position[] = {0, 0, static_cast<float>(level), 1};
      const std::uint32_t expected = ((level + 1) << (32 - bits)) + (1u << (31 - bits));
      ASSERT_EQ(project(t, clip_position(t, 0, 0, position[2], 1)).z, expected) << level << " of " << levels;
      for (const InstructionSet isa : available_isas()) {
        WindowVertex vertex;
        std::uint8_t code = 0;
        transform_vertices(isa)(t, {position, 4}, 4, 1, &vertex, &code);
        ASSERT_EQ(vertex.z, expected) << level << " of " << levels << ", " << static_cast<int>(isa);
      }
    }
  }
}

// Any depth range whose ends are equal.
TEST(DepthRounding, EmptyDepthRangeStoresTheLevelOfAClear) {
  Random random(3);
  const MeshData all = whole_window(0.4f);
  for (const DepthFormat format : kFormats) {
    const std::vector<double> depths = telling_depths(format, random, 500);
    const auto clears = words_of(format, depths, clear_to);
    const auto polygons = words_of(format, depths, [&](Frame& frame, Rect at, double z) {
      DrawState state;
      state.depth.test = Compare::always;
      state.scissor = at;
      state.depth_near = state.depth_far = z;
      frame.draw(all.view(), state);
    });
    for (std::size_t i = 0; i < depths.size(); ++i)
      ASSERT_EQ(polygons[i], clears[i]) << std::hexfloat << depths[i] << ", " << name_of(format);
  }
}

/// Clip coordinates z whose window depth is exactly representable as a double: 0.5 z + 0.5, or z itself when
/// reversed.
std::vector<float> telling_clip_depths(DepthFormat format, bool reversed, Random& random) {
  std::vector<float> telling;
  for (const double z : telling_depths(format, random, long_tests() ? 5000 : 300)) {
    const float at = static_cast<float>(reversed ? z : 2 * z - 1);
    const float low = reversed ? 0.0f : -1.0f;
    for (const float f : {std::nextafter(at, low), at, std::nextafter(at, 1.0f)})
      if (reversed ? f == 0 || f > 0x1p-30f : std::abs(f) > 0x1p-28f) telling.push_back(f);
  }
  return telling;
}

// Whole triangles, small triangles, clipped triangles, points and lines; on each instruction set, with one
// and several samples.
TEST(DepthRounding, PrimitivesParallelToTheScreenStoreTheLevelOfAClear) {
  constexpr int kWidth = 96;
  constexpr int kHeight = 64;
  constexpr int kCell = 8;
  constexpr int kColumns = kWidth / kCell;
  constexpr int kCells = kColumns * (kHeight / kCell);
  Random random(2);
  int turn = 0;
  for (const DepthFormat format : kFormats)
    for (const bool reversed : {false, true}) {
      const std::vector<float> telling = telling_clip_depths(format, reversed, random);
      std::vector<double> depths;
      for (const float z : telling) depths.push_back(reversed ? z : 0.5 * z + 0.5);
      const auto expected = words_of(format, depths, clear_to);
      for (const InstructionSet set : available_instruction_sets()) {
        const int samples = turn++ % 2 == 0 ? 1 : 8;
        Renderer renderer({.threads = 1, .instruction_set = set});
        FrameBuffer buffer({.width = kWidth, .height = kHeight, .depth = format, .samples = samples});
        for (std::size_t first = 0; first < telling.size(); first += kCells) {
          const std::size_t count = std::min<std::size_t>(kCells, telling.size() - first);
          std::vector<MeshData> meshes;
          for (std::size_t i = 0; i < count; ++i) {
            constexpr float kSizes[] = {1.0f, 1000.0f, 1e6f};  // in units of half the viewport
            const float z = telling[first + i];
            const float size = kSizes[i % 3];
            MeshData mesh = rectangle(-size, -size, size, size, z);
            if (i % 5 == 4) {
              mesh = {};
              mesh.primitive = i % 2 == 0 ? Primitive::points : Primitive::lines;
              mesh.positions = {0, 0, z};
              if (i % 2 != 0) mesh.positions = {-2, 0, z, 2, 0, z};
            }
            meshes.push_back(std::move(mesh));
          }
          Frame frame(buffer);
          frame.set_camera({.reversed = reversed});
          for (std::size_t i = 0; i < count; ++i) {
            DrawState state;
            state.depth.test = Compare::always;
            state.viewport = state.scissor = Rect{static_cast<int>(i) % kColumns * kCell,
                                                  static_cast<int>(i) / kColumns * kCell, kCell, kCell};
            state.point_size = state.line_width = 4 * kCell;
            frame.draw(meshes[i].view(), state);
          }
          renderer.finish(frame);
          const auto words = stored_depths(buffer);
          for (int y = 0; y < kHeight; ++y)
            for (int x = 0; x < kWidth; ++x) {
              const std::size_t cell =
                  static_cast<std::size_t>((kHeight - 1 - y) / kCell * kColumns + x / kCell);
              if (cell >= count) continue;
              ASSERT_EQ(words[static_cast<std::size_t>(y * kWidth + x)], expected[first + cell])
                  << std::hexfloat << telling[first + cell] << (reversed ? " reversed" : "") << ", "
                  << name_of(format) << ", " << samples << " samples, cell " << cell << " at " << x << ", "
                  << y << ", on " << name(set);
            }
        }
      }
    }
}

}  // namespace
}  // namespace tessera::test::depth_rounding_test
