// Polygon offset for decals. The same triangles pass again if they are one unit nearer, other polygons in the
// same plane if they are one slope and one unit nearer; without an offset they z-fight. Also the exactness
// that this relies on: cleared and screen-parallel depths are exact in every format, including 32 bits.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <string>

#include "tests/engine/frame/api_support.h"

namespace tessera::polygon_offset_test {
namespace {

using namespace test;

struct Setting {
  const char* name;
  DepthFormat depth;
  bool reversed = false;
  int samples = 1;
};
constexpr Setting kSettings[] = {{"Unorm16", DepthFormat::unorm16},
                                 {"Unorm24", DepthFormat::unorm24},
                                 {"Unorm32", DepthFormat::unorm32},
                                 {"Float32", DepthFormat::float32},
                                 {"ReversedFloat32", DepthFormat::float32, true},
                                 {"Unorm24FourSamples", DepthFormat::unorm24, false, 4}};
const auto kNameOfSetting = [](const auto& setting) { return std::string(setting.param.name); };

constexpr int kWidth = 96;
constexpr int kHeight = 64;
constexpr int kCases = 240;
const Color kRed{1, 0, 0, 1};
const Color kGreen{0, 1, 0, 1};
constexpr std::uint32_t kGreenWord = 0x00ff00;

class Decals : public testing::TestWithParam<Setting> {
 protected:
  const Setting setting = GetParam();
  const float nearer = setting.reversed ? 1.0f : -1.0f;
  Renderer renderer{{.threads = 1}};
  FrameBuffer buffer{
      {.width = kWidth, .height = kHeight, .depth = setting.depth, .samples = setting.samples}};
  Frame frame{buffer};

  Camera camera() const {
    const double far = setting.reversed ? std::numeric_limits<double>::infinity() : 60;
    return {.projection = perspective(50, static_cast<double>(kWidth) / kHeight, 0.5, far, setting.reversed),
            .reversed = setting.reversed};
  }
  void draw(const MeshData& mesh, const Color& color, const Matrix& transform,
            const PolygonOffset& offset = {}) {
    DrawState state = unlit(color);
    state.transform = transform;
    state.depth.test = setting.reversed ? Compare::greater : Compare::less;
    state.polygon_offset = offset;
    frame.draw(mesh.view(), state);
  }
  void begin() {
    frame.clear({.color = Color{0, 0, 0, 1}, .depth = setting.reversed ? 0.0 : 1.0});
    frame.set_camera(camera());
  }
  std::vector<std::uint32_t> words_of_frame() {
    renderer.finish(frame);
    return packed_colors(buffer);
  }
};

// Views of the plane: head-on, nearly head-on, and at grazing angles.
Matrix random_transform(Random& random, int turn) {
  const bool is_head_on = turn % 10 == 0;
  double tilt = 0;  // degrees
  if (!is_head_on)
    tilt = turn % 3 == 0 ? std::pow(10.0, random.between(-6, 0)) * 60 : double{random.between(0, 85)};
  const Matrix away = translate(random.between(-1, 1), random.between(-0.7f, 0.7f), random.between(-14, -3));
  if (is_head_on) return away;
  return away * rotate(random.between(0, 360), 0, 0, 1) * rotate(tilt, random.between(-1, 1), 1, 0) *
         rotate(random.between(0, 360), 0, 0, 1);
}

// A sheet of 4 x 4 irregular quads.
MeshData random_sheet(Random& random) {
  MeshData mesh;
  constexpr std::uint32_t kSide = 5;
  for (std::uint32_t y = 0; y < kSide; ++y)
    for (std::uint32_t x = 0; x < kSide; ++x)
      for (const std::uint32_t at : {x, y, kSide})
        mesh.positions.push_back(at == kSide
                                     ? random.between(-0.4f, 0.4f)
                                     : (static_cast<float>(at) - 2) * 0.7f + random.between(-0.3f, 0.3f));
  for (std::uint32_t y = 0; y + 1 < kSide; ++y)
    for (std::uint32_t x = 0; x + 1 < kSide; ++x) {
      const std::uint32_t a = y * kSide + x;
      mesh.indices.insert(mesh.indices.end(), {a, a + 1, a + kSide + 1, a, a + kSide + 1, a + kSide});
    }
  return mesh;
}

TEST_P(Decals, SameTrianglesPassOneUnitNearer) {
  Random random(51);
  std::size_t visible = 0;
  for (int turn = 0; turn < kCases; ++turn) {
    const MeshData sheet = random_sheet(random);
    const Matrix transform = random_transform(random, turn);
    begin();
    draw(sheet, kRed, transform);
    draw(sheet, kGreen, transform, {0, nearer});
    for (const std::uint32_t word : words_of_frame()) {
      ASSERT_EQ(word >> 16, 0u) << "case " << turn << " shows the surface below";
      visible += word != 0;
    }
    // Without an offset the same triangle has the same depths again and fails the test.
    begin();
    draw(sheet, kRed, transform);
    draw(sheet, kGreen, transform);
    for (const std::uint32_t word : words_of_frame()) ASSERT_EQ(word & 0x00ff00u, 0u) << "case " << turn;
  }
  EXPECT_GT(visible, std::size_t{100} * kCases);
}

// A triangle in the plane z = 0, not a sliver, within the square of the base.
MeshData random_decal(Random& random) {
  for (;;) {
    float p[6];
    for (float& v : p) v = random.between(-1.4f, 1.4f);
    const float area = (p[2] - p[0]) * (p[5] - p[1]) - (p[4] - p[0]) * (p[3] - p[1]);
    if (std::abs(area) > 0.8f) return {.positions = {p[0], p[1], 0, p[2], p[3], 0, p[4], p[5], 0}};
  }
}

// max(|dz/dx|, |dz/dy|) of the mesh's plane in the window, in units of the format's smallest depth
// difference.
double slope_in_units(const Setting& setting, const Camera& camera, const Matrix& transform,
                      const MeshData& mesh) {
  const Matrix clip_from_object = camera.projection * camera.view * transform;
  Vec3 window[4];
  double largest = 0;
  for (std::size_t v = 0; v < 4; ++v) {
    double clip[4];
    for (std::size_t row = 0; row < 4; ++row) {
      const double* const m = clip_from_object.m.data() + 4 * row;
      clip[row] = m[0] * mesh.positions[3 * v] + m[1] * mesh.positions[3 * v + 1] +
                  m[2] * mesh.positions[3 * v + 2] + m[3];
    }
    const double z = clip[2] / clip[3];
    window[v] = {clip[0] / clip[3] * kWidth / 2, clip[1] / clip[3] * kHeight / 2,
                 camera.reversed ? z : (z + 1) / 2};
    largest = std::max(largest, std::abs(window[v].z));
  }
  const auto along = [&](std::size_t v) {
    return Vec3{window[v].x - window[0].x, window[v].y - window[0].y, window[v].z - window[0].z};
  };
  const Vec3 a = along(1);
  const Vec3 b = along(3);
  const double area = a.x * b.y - a.y * b.x;
  const double slope =
      std::max(std::abs(a.z * b.y - a.y * b.z), std::abs(a.x * b.z - a.z * b.x)) / std::abs(area);
  switch (setting.depth) {
    case DepthFormat::unorm16: return slope * 65535;
    case DepthFormat::unorm24: return slope * 16777215;
    case DepthFormat::unorm32: return slope * 4294967295;
    default: return slope / std::ldexp(1.0, std::ilogb(largest) - 23);
  }
}

TEST_P(Decals, CoplanarPolygonsPassOneSlopeAndTheirRoundingNearer) {
  Random random(52);
  const MeshData base = rectangle(-1.5f, -1.5f, 1.5f, 1.5f);
  std::size_t visible = 0;
  int fights = 0;
  for (int turn = 0; turn < kCases; ++turn) {
    const MeshData decal = random_decal(random);
    const Matrix transform = random_transform(random, turn);
    begin();
    draw(decal, kGreen, transform);
    const std::vector<std::uint32_t> alone = words_of_frame();
    const auto hidden = [&](const PolygonOffset& offset) {
      begin();
      draw(base, kRed, transform);
      draw(decal, kGreen, transform, offset);
      const std::vector<std::uint32_t> words = words_of_frame();
      int count = 0;
      for (std::size_t i = 0; i < words.size(); ++i)
        count += alone[i] == kGreenWord && words[i] != kGreenWord;
      return count;
    };
    // float32 depths of either plane are rounded by up to two units, because each plane starts from a
    // different vertex.
    const double slope = slope_in_units(setting, camera(), transform, base);
    const float units = setting.depth == DepthFormat::float32 ? 5.0f : 1.0f;
    ASSERT_EQ(hidden({nearer, nearer * units}), 0)
        << "case " << turn << ", a slope of " << slope << " units a pixel";
    fights += hidden({}) > 0;
    visible += static_cast<std::size_t>(std::count(alone.begin(), alone.end(), kGreenWord));
  }
  EXPECT_GT(visible, std::size_t{50} * kCases);
  EXPECT_GT(fights, kCases * 3 / 4) << "without an offset too few cases z-fight to prove anything";
}

INSTANTIATE_TEST_SUITE_P(Depths, Decals, testing::ValuesIn(kSettings), kNameOfSetting);

// True if `level` is floor(d (2^bits - 1) + 0.5), in integers: d is a multiple of 2^-shift. Within a
// millionth of a level around the middle between two levels, doubles round either way (0.3 is such a value at
// 16 and at 32 bits), so both are accepted there.
bool is_level_of(std::uint32_t level, double d, int bits) {
  __extension__ using Wide = __int128;
  int exponent = 0;
  const double mantissa = std::frexp(d, &exponent);
  const int shift = 53 - exponent;  // at least 52
  if (shift > 90) return level == 0;
  const Wide exact = static_cast<Wide>(std::ldexp(mantissa, 53)) * ((Wide{1} << bits) - 1);
  const Wide distance = exact - (Wide{level} << shift);
  const Wide half = Wide{1} << (shift - 1);
  const Wide doubt = Wide{1} << (shift - 20);
  return distance >= -half - doubt && distance < half + doubt;
}
bool is_word_of(std::uint32_t word, double d, DepthFormat depth) {
  if (depth == DepthFormat::float32) return word == std::bit_cast<std::uint32_t>(static_cast<float>(d));
  if (depth == DepthFormat::unorm16) return is_level_of(word, d, 16);
  return is_level_of(word, d, depth == DepthFormat::unorm24 ? 24 : 32);
}

std::vector<double> awkward_depths() {
  std::vector<double> depths{0,           1,           0.5,         0.1,         0.2,         0.3,
                             1.0 / 3,     2.0 / 3,     0.7,         0.9,         0.99999,     1 - 0x1p-16,
                             1 - 0x1p-24, 1 - 0x1p-25, 1 - 0x1p-30, 1 - 0x1p-31, 1 - 0x1p-32, 1 - 0x1p-33,
                             1 - 0x1p-34, 1 - 0x1p-53, 0x1p-16,     0x1p-24,     0x1p-31,     0x1p-32,
                             0x1p-33,     0x1.8p-32,   0x1p-60};
  // Values around the middle between two levels.
  for (const double level : {0.0, 1.0, 16777216.0, 2147483647.0, 4294967000.0, 4294967293.0}) {
    const double middle = (level + 0.5) / 4294967295.0;
    depths.insert(depths.end(), {middle - 0x1p-50, middle, middle + 0x1p-50});
  }
  Random random(53);
  for (int i = 0; i < 400; ++i)
    depths.push_back((random.next() * 0x1p32 + random.next()) * 0x1p-64 * (i % 4 == 0 ? 0x1p-8 : 1));
  return depths;
}

// llvmpipe, Mesa's software driver, is known to fail this at 32 bits: its clears of a 32-bit depth buffer
// lose precision.
class ExactDepth : public testing::TestWithParam<Setting> {};

TEST_P(ExactDepth, IsEqualInClearsAndScreenParallelDraws) {
  const Setting setting = GetParam();
  Renderer renderer({.threads = 1});
  FrameBuffer buffer({.width = 40, .height = 36, .depth = setting.depth, .samples = setting.samples});
  Frame frame(buffer);
  const MeshData window = whole_window();
  const auto all_are = [](const std::vector<std::uint32_t>& words, std::uint32_t word) {
    return std::count(words.begin(), words.end(), word) == std::ssize(words);
  };
  for (const double depth : awkward_depths()) {
    SCOPED_TRACE(testing::Message() << std::hexfloat << depth);
    frame.clear({.color = Color{0, 0, 0, 1}, .depth = depth});
    renderer.finish(frame);
    const std::uint32_t word = stored_depths(buffer).front();
    ASSERT_TRUE(is_word_of(word, depth, setting.depth)) << word << " is cleared";
    ASSERT_TRUE(all_are(stored_depths(buffer), word));
    // The same depth through the depth range, and through the transform if that is exact.
    for (const bool by_range : {true, false}) {
      if (!by_range && depth < 0.5) continue;
      DrawState state = unlit({1, 1, 1, 1});
      state.depth.test = Compare::equal;
      if (by_range) state.depth_near = state.depth_far = depth;
      else state.transform = translate(0, 0, 2 * depth - 1);
      frame.clear({.color = Color{0, 0, 0, 1}});
      frame.draw(window.view(), state);
      renderer.finish(frame);
      ASSERT_TRUE(all_are(packed_colors(buffer), 0xffffffu)) << (by_range ? "by range" : "by transform");
      ASSERT_TRUE(all_are(stored_depths(buffer), word));
    }
  }
}

// Partial clears reach the planes by another path than full clears.
TEST_P(ExactDepth, IsEqualInPartialClears) {
  const Setting setting = GetParam();
  Renderer renderer({.threads = 1});
  FrameBuffer buffer({.width = 40, .height = 36, .depth = setting.depth, .samples = setting.samples});
  Frame frame(buffer);
  for (const double depth : awkward_depths()) {
    frame.clear({.depth = 0.25});
    frame.clear({.depth = depth, .scissor = Rect{0, 0, 7, 36}});
    renderer.finish(frame);
    const std::vector<std::uint32_t> words = stored_depths(buffer);
    for (std::size_t i = 0; i < words.size(); ++i)
      ASSERT_TRUE(is_word_of(words[i], i % 40 < 7 ? depth : 0.25, setting.depth))
          << words[i] << " at " << i % 40 << " of " << std::hexfloat << depth;
  }
}

INSTANTIATE_TEST_SUITE_P(Depths, ExactDepth, testing::ValuesIn(kSettings), kNameOfSetting);

// In unorm formats a unit is one level at every pixel: the offset shifts the triangle's depths by whole
// levels.
TEST(PolygonOffset, MovesUnormDepthsByWholeLevels) {
  Random random(77);
  Renderer renderer({.threads = 1});
  for (const DepthFormat format : {DepthFormat::unorm16, DepthFormat::unorm24, DepthFormat::unorm32}) {
    FrameBuffer buffer({.width = 64, .height = 64, .depth = format});
    for (int round = 0; round < 300; ++round) {
      MeshData mesh;
      if (round == 0) {
        // All vertices on pixel centres; depth steps are not exact in binary.
        mesh.positions = {-0.671875f, -0.671875f, 0,          -0.359375f, -0.671875f,
                          2.3846e-7f, -0.671875f, -0.359375f, 0};
      } else {
        const float steepness = std::exp2(random.between(-22, -1));
        for (int i = 0; i < 9; ++i)
          mesh.positions.push_back(i % 3 == 2 ? steepness * random.between(-0.9f, 0.9f)
                                              : std::round(random.between(-31, 31)) / 32 +
                                                    (round % 2 == 0 ? 1 / 64.0f : 0));
      }
      const auto depths = [&](float units) {
        Frame frame(buffer);
        frame.clear({.depth = 1.0});
        DrawState state = unlit({1, 1, 1, 1});
        state.polygon_offset.units = units;
        frame.draw(mesh.view(), state);
        renderer.finish(frame);
        return stored_depths(buffer);
      };
      const std::vector<std::uint32_t> plain = depths(0);
      const std::vector<std::uint32_t> nearer = depths(-1);
      const std::vector<std::uint32_t> farther = depths(3);
      std::uint32_t far_end = 0xffffffffu;
      if (format == DepthFormat::unorm16) far_end = 0xffffu;
      if (format == DepthFormat::unorm24) far_end = 0xffffffu;
      for (std::size_t i = 0; i < plain.size(); ++i) {
        if (plain[i] == far_end) continue;
        ASSERT_EQ(nearer[i], plain[i] - 1)
            << "round " << round << ", pixel " << i << ", " << static_cast<int>(format);
        ASSERT_EQ(farther[i], plain[i] + 3)
            << "round " << round << ", pixel " << i << ", " << static_cast<int>(format);
      }
    }
  }
}

// Clipping cuts the triangle into parts with maximum depths of 0.3 and 0.9, whose units differ. Its neighbour
// is not clipped.
TEST(PolygonOffset, IsTheSameForAllPartsOfAClippedTriangle) {
  MeshData mesh;
  mesh.positions = {-0.9f, -0.9f, -3,    0.9f,  -0.9f, 0.8f,  0,    0.9f, -0.4f,
                    0.95f, 0.9f,  -0.5f, 0.95f, 0,     -0.6f, 0.5f, 0.9f, -0.7f};
  for (const float factor : {0.0f, 0.25f}) {
    const auto depths = [&](bool offset, bool neighbor_alone = false) {
      FrameBuffer buffer({.width = 64, .height = 64, .depth = DepthFormat::float32});
      Frame frame(buffer);
      frame.clear({.depth = 1.0});
      DrawState state = unlit({1, 1, 1, 1});
      if (offset) state.polygon_offset = {factor, 0x1p20f};
      MeshData drawn = mesh;
      if (neighbor_alone) drawn.positions.erase(drawn.positions.begin(), drawn.positions.begin() + 9);
      frame.draw(drawn.view(), state);
      Renderer({.threads = 1}).finish(frame);
      std::vector<float> depth(64 * 64);
      buffer.read_depth(depth);
      return depth;
    };
    const std::vector<float> plain = depths(false);
    const std::vector<float> moved = depths(true);
    const std::vector<float> neighbor = depths(true, true);
    float min_shift = 1, max_shift = 0;
    int count = 0;
    int neighbor_count = 0;
    for (std::size_t i = 0; i < plain.size(); ++i) {
      if (neighbor[i] != 1) {
        ++neighbor_count;
        ASSERT_EQ(moved[i], neighbor[i]) << "other draws have no effect";
      } else if (plain[i] != 1) {
        ++count;
        min_shift = std::min(min_shift, moved[i] - plain[i]);
        max_shift = std::max(max_shift, moved[i] - plain[i]);
      }
    }
    EXPECT_GT(count, 500);
    EXPECT_GT(neighbor_count, 50);
    EXPECT_LT(max_shift - min_shift, 1e-6f) << factor;
    if (factor == 0) {
      EXPECT_NEAR(min_shift, 0x1p-4f, 1e-6f);  // 2^20 units of 2^-24: the maximum depth is 0.9
    }
  }
}

// Depth saturates at 0 or 1 however large the offset is; it does not wrap around.
TEST(PolygonOffset, SaturatesAtTheDepthRange) {
  for (const DepthFormat format :
       {DepthFormat::unorm16, DepthFormat::unorm24, DepthFormat::unorm32, DepthFormat::float32})
    for (const float units : {-5e9f, -1e18f, 5e9f, 1e18f}) {
      FrameBuffer buffer({.width = 64, .height = 64, .depth = format});
      Frame frame(buffer);
      frame.clear({.depth = 0.5});
      MeshData mesh = whole_window();
      for (std::size_t vertex = 0; vertex < 4; ++vertex)
        mesh.positions[3 * vertex + 2] = mesh.positions[3 * vertex] > 0 ? 1.0f : -1.0f;
      DrawState state = unlit({1, 1, 1, 1});
      state.depth.test = Compare::always;
      state.polygon_offset.units = format == DepthFormat::float32 ? units * 1e15f : units;
      frame.draw(mesh.view(), state);
      Renderer({.threads = 1}).finish(frame);
      std::vector<float> depth(64 * 64);
      buffer.read_depth(depth);
      for (const float d : depth)
        ASSERT_EQ(d, units < 0 ? 0.0f : 1.0f) << static_cast<int>(format) << " " << units;
    }
}

}  // namespace
}  // namespace tessera::polygon_offset_test
