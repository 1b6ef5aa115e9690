// Texels against the definitions of the filters in double [GL 2.1, 3.8.8, 3.8.9], on textures with unrelated
// levels; bit-identical on every instruction set.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <vector>

#include "tests/raster/tile_harness.h"
#include "tests/shading/texture_lanes.h"

namespace tessera::test::texture_sampling_test {
namespace {

// Minification filters: nearest_linear is GL_NEAREST_MIPMAP_LINEAR.
enum class Min { nearest, linear, nearest_nearest, linear_nearest, nearest_linear, linear_linear };
constexpr Min kMins[] = {Min::nearest,        Min::linear,         Min::nearest_nearest,
                         Min::linear_nearest, Min::nearest_linear, Min::linear_linear};
constexpr TextureWrap kWraps[] = {TextureWrap::repeat, TextureWrap::clamp_to_edge,
                                  TextureWrap::mirrored_repeat};

struct TestTexture {
  TextureLevels levels;
  std::vector<std::uint32_t> words;
  Min min;

  TestTexture(std::mt19937& random, int width, int height, bool mag_linear, Min min_filter,
              TextureWrap wrap_s, TextureWrap wrap_t)
      : min(min_filter) {
    levels.mag_linear = mag_linear;
    levels.min_linear = min == Min::linear || min == Min::linear_nearest || min == Min::linear_linear;
    levels.blends_levels = min == Min::nearest_linear || min == Min::linear_linear;
    levels.magnification_limit =
        mag_linear && (min == Min::nearest_nearest || min == Min::nearest_linear) ? 2.0f : 1.0f;
    levels.wrap_s = wrap_s;
    levels.wrap_t = wrap_t;
    add_level(random, 0, width, height);
    while (min != Min::nearest && min != Min::linear && (width > 1 || height > 1)) {
      width = std::max(width / 2, 1);
      height = std::max(height / 2, 1);
      add_level(random, ++levels.last, width, height);
    }
    levels.words = words.data();
  }
  double component(int level, std::int64_t i, std::int64_t j, int c) const {
    const TextureLevel& l = levels.level[level];
    return words[static_cast<std::size_t>(l.first + j * l.stride + i)] >> kTexelShift[c] & 0xff;
  }

 private:
  void add_level(std::mt19937& random, int number, int width, int height) {
    const TextureLevel level(static_cast<std::int32_t>(words.size()), width, height);
    levels.level[number] = level;
    words.resize(words.size() + static_cast<std::size_t>(level.words()));
    std::uint32_t* const first = words.data() + level.first;
    for (int j = 0; j < height; ++j) {
      std::uint32_t* const row = first + j * level.stride;
      for (int i = 0; i < width; ++i) row[i] = static_cast<std::uint32_t>(random());
      row[width] = levels.wrap_s == TextureWrap::repeat ? row[0] : row[width - 1];
    }
    if (height > 1)
      std::memcpy(first + height * level.stride,
                  levels.wrap_t == TextureWrap::repeat ? first : first + (height - 1) * level.stride,
                  sizeof(std::uint32_t) * static_cast<std::size_t>(level.stride));
  }
};

// Wraps a texel index as GL_TEXTURE_WRAP does, in integers.
std::int64_t wrapped_index(std::int64_t i, TextureWrap wrap, std::int64_t size) {
  const auto modulo = [](std::int64_t a, std::int64_t n) { return (a % n + n) % n; };
  if (wrap == TextureWrap::repeat) return modulo(i, size);
  if (wrap == TextureWrap::clamp_to_edge) return std::min(std::max<std::int64_t>(i, 0), size - 1);
  const std::int64_t there_and_back = modulo(i, 2 * size);
  return there_and_back < size ? there_and_back : 2 * size - 1 - there_and_back;
}

// One component at one level, through unwrapped indices, independently of the kernel.
double level_component(const TestTexture& texture, int level, bool linear, double s, double t, int c) {
  const TextureLevel& l = texture.levels.level[level];
  const auto at = [&](std::int64_t i, std::int64_t j) {
    return texture.component(level, wrapped_index(i, texture.levels.wrap_s, l.width),
                             wrapped_index(j, texture.levels.wrap_t, l.height), c);
  };
  const double u = s * l.width, v = t * l.height;
  if (!linear) return at(static_cast<std::int64_t>(std::floor(u)), static_cast<std::int64_t>(std::floor(v)));
  const double left = std::floor(u - 0.5), below = std::floor(v - 0.5);
  const double a = u - 0.5 - left, b = v - 0.5 - below;
  const auto i = static_cast<std::int64_t>(left), j = static_cast<std::int64_t>(below);
  return (1 - a) * (1 - b) * at(i, j) + a * (1 - b) * at(i + 1, j) + (1 - a) * b * at(i, j + 1) +
         a * b * at(i + 1, j + 1);
}

double expected_component(const TestTexture& texture, double s, double t, double lambda, int c) {
  const TextureLevels& levels = texture.levels;
  const bool min_is_nearest = texture.min == Min::nearest_nearest || texture.min == Min::nearest_linear;
  const double magnification_limit = levels.mag_linear && min_is_nearest ? 0.5 : 0.0;
  if (lambda <= magnification_limit) return level_component(texture, 0, levels.mag_linear, s, t, c);
  if (texture.min == Min::nearest || texture.min == Min::linear)
    return level_component(texture, 0, levels.min_linear, s, t, c);
  const double q = levels.last;
  if (!levels.blends_levels) {
    const double d = lambda <= 0.5 ? 0 : std::min(std::ceil(lambda + 0.5) - 1, q);
    return level_component(texture, static_cast<int>(d), levels.min_linear, s, t, c);
  }
  const int d1 = static_cast<int>(lambda >= q ? q : std::floor(lambda));
  const int d2 = lambda >= q ? d1 : d1 + 1;
  const double share = lambda - std::floor(lambda);
  return (1 - share) * level_component(texture, d1, levels.min_linear, s, t, c) +
         share * level_component(texture, d2, levels.min_linear, s, t, c);
}

// Whether the point is away from borders between texels at all levels: nearest filters are unambiguous.
bool is_clear(const TestTexture& texture, double s, double t) {
  const auto is_near_border = [](double x) { return std::abs(x - std::round(x)) < 2e-4; };
  const bool has_rows = texture.levels.level[0].height > 1;
  for (int level = 0; level <= texture.levels.last; ++level) {
    if (is_near_border(s * texture.levels.level[level].width)) return false;
    if (has_rows && is_near_border(t * texture.levels.level[level].height)) return false;
  }
  return true;
}

template <class Check>
void for_each_filter(const Check& check) {
  std::mt19937 random(5);
  constexpr int kSizes[][2] = {{16, 16}, {64, 8}, {7, 5}, {33, 17}, {1, 6}, {9, 1}, {1, 1}, {256, 128}};
  for (const auto& [width, height] : kSizes)
    for (const bool mag_linear : {false, true})
      for (const Min min : kMins)
        for (const TextureWrap wrap_s : kWraps)
          for (const TextureWrap wrap_t : kWraps)
            check(TestTexture(random, width, height, mag_linear, min, wrap_s, wrap_t), random);
}

TEST(TextureSampling, MatchesTheFilterDefinitions) {
  double worst = 0;
  for_each_filter([&](const TestTexture& texture, std::mt19937& random) {
    const auto between = [&](double low, double high) {
      return std::uniform_real_distribution<double>(low, high)(random);
    };
    ShadingBatch batch{};
    float lambda[kBatchPoints];
    for (int i = 0; i < kBatchPoints; ++i) {
      // Levels of detail that vary within a block, and constant ones.
      lambda[i] = static_cast<float>(i < 32 ? between(-1.5, 10) : 1.7);
      float s, t;
      do {
        s = static_cast<float>(between(-2.5, 3.5));
        t = static_cast<float>(between(-2.5, 3.5));
      } while (!is_clear(texture, s, t));
      batch.field[kTextureS][i] = s;
      batch.field[kTextureT][i] = t;
      batch.field[kFootprintSquared][i] = static_cast<float>(std::exp2(2.0 * lambda[i]));
    }
    for (const InstructionSet isa : available_isas()) {
      ShadingBatch out = batch;
      sample_texture(isa)(texture.levels, out, kBatchPoints);
      for (int i = 0; i < kBatchPoints; ++i) {
        const double t = texture.levels.level[0].height == 1 ? 0 : double{batch.field[kTextureT][i]};
        const double detail = 0.5 * std::log2(double{batch.field[kFootprintSquared][i]});
        const bool is_unfiltered_mag = detail <= 0 && !texture.levels.mag_linear;
        const bool is_unfiltered_min =
            detail > 0.5 && !texture.levels.min_linear && !texture.levels.blends_levels;
        for (int c = 0; c < 4; ++c) {
          const double expected = expected_component(texture, batch.field[kTextureS][i], t, detail, c);
          const double off = std::abs(255.0 * out.field[kTexelR + c][i] - expected);
          ASSERT_LE(off, is_unfiltered_mag || is_unfiltered_min ? 1e-4 : 0.06)
              << name_of(isa) << ", " << texture.levels.level[0].width << "x"
              << texture.levels.level[0].height << ", min " << static_cast<int>(texture.min)
              << ", mag linear " << texture.levels.mag_linear << ", wraps "
              << static_cast<int>(texture.levels.wrap_s) << " " << static_cast<int>(texture.levels.wrap_t)
              << ", s " << batch.field[kTextureS][i] << ", t " << t << ", level of detail " << detail
              << ", component " << c << ", expected " << expected;
          worst = std::max(worst, off);
        }
      }
    }
  });
  std::printf("[  figure  ] texels are off by at most %.3g levels\n", worst);
}

// Far from the origin a float coordinate is coarse, but its exact value selects the texels.
TEST(TextureSampling, RepeatsExactlyAtAnyDistance) {
  std::mt19937 random(7);
  for (const int width : {100, 1000, 1024, 3000}) {
    TestTexture texture(random, width, 1, true, Min::linear, TextureWrap::repeat, TextureWrap::repeat);
    for (std::size_t i = 0; i <= static_cast<std::size_t>(width); ++i)
      texture.words[i] = i % 2 == 0 || i == static_cast<std::size_t>(width) ? 0 : 0xffffffff;
    ShadingBatch batch{};
    std::uniform_real_distribution<float> far(-4096, 4096);
    for (int round = 0; round < 20; ++round) {
      for (int i = 0; i < kBatchPoints; ++i) batch.field[kTextureS][i] = far(random);
      // Before the first centre, at it, just below 0, just below 1 (rounds to the end), and 0.
      const float edges[] = {std::nextafter(0.5f / static_cast<float>(width), 0.0f),
                             0.5f / static_cast<float>(width), -1e-30f, std::nextafter(1.0f, 0.0f), 0.0f};
      std::ranges::copy(edges, batch.field[kTextureS]);
      for (const InstructionSet isa : available_isas()) {
        ShadingBatch out = batch;
        sample_texture(isa)(texture.levels, out, kBatchPoints);
        for (int i = 0; i < kBatchPoints; ++i)
          ASSERT_NEAR(255 * out.field[kTexelR][i],
                      level_component(texture, 0, true, batch.field[kTextureS][i], 0, 0), 0.06)
              << name_of(isa) << ", width " << width << ", s " << batch.field[kTextureS][i];
      }
    }
  }
}

// GL 2.1, 3.8.8: d = ceil(lambda + 1/2) - 1, so halfway between two levels the larger one is the nearest.
TEST(TextureSampling, HalfwayBetweenLevelsTheLargerIsNearest) {
  std::mt19937 random(6);
  const TestTexture texture(random, 64, 64, false, Min::nearest_nearest, TextureWrap::repeat,
                            TextureWrap::repeat);
  ShadingBatch batch{};
  for (int i = 0; i < kBatchPoints; ++i) {
    batch.field[kTextureS][i] = batch.field[kTextureT][i] = 0.3f;
    batch.field[kFootprintSquared][i] = std::exp2(static_cast<float>(2 * (i % 6) + 1));
  }
  for (const InstructionSet isa : available_isas()) {
    sample_texture(isa)(texture.levels, batch, kBatchPoints);
    for (int i = 0; i < kBatchPoints; ++i)
      EXPECT_NEAR(255 * batch.field[kTexelR][i], level_component(texture, i % 6, false, 0.3f, 0.3f, 0), 1e-4)
          << i % 6 << " and a half, " << name_of(isa);
  }
}

// Unused lanes may hold any value: they still sample texels of the texture, identically on every instruction
// set, and never read outside of it.
TEST(TextureSampling, IsIdenticalOnEveryInstructionSetForAnyInput) {
  for_each_filter([&](const TestTexture& texture, std::mt19937& random) {
    ShadingBatch batch{};
    for (int i = 0; i < kBatchPoints; ++i) {
      const auto any = [&] { return std::bit_cast<float>(static_cast<std::uint32_t>(random())); };
      batch.field[kTextureS][i] =
          i % 3 == 0 ? any() : static_cast<float>(static_cast<int>(random() % 64)) / 16.0f - 2;
      batch.field[kTextureT][i] =
          i % 5 == 0 ? any() : static_cast<float>(static_cast<int>(random() % 64)) / 16.0f - 2;
      batch.field[kFootprintSquared][i] =
          i % 2 == 0 ? any() : std::exp2(static_cast<float>(random() % 24) - 3.0f);
    }
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    constexpr float kOdd[] = {kInfinity, -kInfinity, kNan,    1e30f, -1e30f, 16777217.0f,
                              -1e-30f,   1e-45f,     -1e-45f, 0.0f,  -0.0f,  1.0f};
    for (int i = 0; i < 12; ++i) {
      batch.field[kTextureS][i] = kOdd[i];
      batch.field[kTextureT][16 + i] = kOdd[i];
      batch.field[kFootprintSquared][32 + i] = kOdd[i];
    }
    ShadingBatch expected = batch;
    sample_texture(InstructionSet::scalar)(texture.levels, expected, kBatchPoints);
    TextureLevels levels = texture.levels;
    for (const InstructionSet isa : available_isas())
      for (const bool gathers : {false, true}) {
        if (gathers && isa != InstructionSet::avx512) continue;
        levels.gathers_pairs = gathers;
        ShadingBatch out = batch;
        sample_texture(isa)(levels, out, kBatchPoints);
        for (int c = 0; c < 4; ++c)
          for (int i = 0; i < kBatchPoints; ++i) {
            ASSERT_EQ(std::bit_cast<std::uint32_t>(out.field[kTexelR + c][i]),
                      std::bit_cast<std::uint32_t>(expected.field[kTexelR + c][i]))
                << name_of(isa) << (gathers ? ", gathers" : "") << ", s " << batch.field[kTextureS][i]
                << ", t " << batch.field[kTextureT][i] << ", texels squared "
                << batch.field[kFootprintSquared][i];
            ASSERT_TRUE(out.field[kTexelR + c][i] >= 0 && out.field[kTexelR + c][i] <= 1);
          }
      }
  });
}

// All 16-bit components. The kernel divides by a product and its correction, and packs unchanged texels
// without floats.
TEST(TextureSampling, ComponentsAreDividedAndRoundedExactly) {
  for (const InstructionSet isa : available_isas())
    for (int first = 0; first <= 65280; first += 16) {
      std::uint16_t components[16];
      for (int i = 0; i < 16; ++i) components[i] = static_cast<std::uint16_t>(std::min(first + i, 65280));
      float units[16];
      std::uint32_t packed[16];
      texel_components(isa)(components, units, packed);
      for (int i = 0; i < 16; ++i) {
        ASSERT_EQ(units[i], static_cast<float>(components[i]) / kTexelOne)
            << name_of(isa) << " " << components[i];
        ASSERT_EQ(packed[i], 0x010101u * static_cast<std::uint32_t>(std::fma(units[i], 255.0f, 0.5f)))
            << name_of(isa) << " " << components[i];
      }
    }
}

// A uniform texture yields exactly its colour under every filter, and 255 is exactly 1.
TEST(TextureSampling, OneColorStaysExact) {
  std::mt19937 random(9);
  for (const Min min : kMins) {
    TestTexture texture(random, 12, 20, true, min, TextureWrap::repeat, TextureWrap::mirrored_repeat);
    for (std::uint32_t& word : texture.words) word = 0xff01b380;
    ShadingBatch batch{};
    for (int i = 0; i < kBatchPoints; ++i) {
      batch.field[kTextureS][i] = 0.173f * static_cast<float>(i);
      batch.field[kTextureT][i] = 0.091f * static_cast<float>(i);
      batch.field[kFootprintSquared][i] = 0.7f * static_cast<float>(i);
    }
    for (const InstructionSet isa : available_isas()) {
      sample_texture(isa)(texture.levels, batch, kBatchPoints);
      for (int i = 0; i < kBatchPoints; ++i) {
        EXPECT_EQ(batch.field[kTexelA][i], 1.0f);
        EXPECT_EQ(batch.field[kTexelR][i], static_cast<float>(0x01 << 8) / kTexelOne);
        EXPECT_EQ(batch.field[kTexelG][i], static_cast<float>(0xb3 << 8) / kTexelOne);
        EXPECT_EQ(batch.field[kTexelB][i], static_cast<float>(0x80 << 8) / kTexelOne);
      }
    }
  }
}

}  // namespace
}  // namespace tessera::test::texture_sampling_test
