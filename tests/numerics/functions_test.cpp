// Sines, reciprocal square roots, levels of detail and colour distances against long double. All instruction
// sets give the same bits (other tests compare them), so only the fastest is measured.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

#include "framebuffer/palette_search.h"
#include "framebuffer/trigonometry.h"
#include "shading/lighting.h"
#include "tests/numerics/bounds.h"
#include "tests/numerics/every_float.h"
#include "tests/shading/texture_lanes.h"

namespace tessera::test::functions_test {
using namespace detail;
namespace {

TEST(MathFunctions, SinesAndCosines) {
  long double worst = 0;
  std::mt19937 random(5);
  const auto check = [&](double degrees) {
    const long double turn =
        std::remainder(static_cast<long double>(degrees), 360.0L) * (std::numbers::pi_v<long double> / 180);
    const SineCosine found = sine_cosine(degrees);
    update_worst(worst, std::abs(found.sine - std::sin(turn)), std::abs(found.cosine - std::cos(turn)));
  };
  for (int i = -720 * 1024; i <= 720 * 1024; ++i) check(i / 1024.0);
  for (int i = 0; i < 1000000; ++i)
    check(std::ldexp(static_cast<double>(random()) - 0x1p31, static_cast<int>(random() % 64) - 40));
  expect_within("sine and cosine of degrees, absolute", worst, 1e-15L, "");
  for (int quarter = -8; quarter <= 8; ++quarter) {
    const SineCosine found = sine_cosine(90.0 * quarter);
    constexpr double kSines[] = {0, 1, 0, -1};
    EXPECT_EQ(found.sine, kSines[quarter & 3]);
    EXPECT_EQ(found.cosine, kSines[(quarter + 1) & 3]);
  }
}

// The square root of a rounded square is the number itself; only the reciprocal rounds.
TEST(MathFunctions, Reciprocals) {
  long double worst = 0;
  EyeLight light{.ambient = {0x1p-61f, 0, 0}, .diffuse = {0, 0, 0}, .specular = {0, 0, 0}};
  light.directional = false;
  light.position = {0, 0, 0};
  light.attenuation = {0, 1, 0};
  const LightingProgram program = plan_lighting({.ambient = {1, 0, 0}, .diffuse = {0, 0, 0}}, {}, {light},
                                                {.scene_ambient = {0, 0, 0}}, nullptr);
  for_floats(bits_of(0x1p-60f), bits_of(0x1p60f), [&](const std::vector<float>& distances) {
    for (std::size_t at = 0; at < distances.size(); at += kFloatBatch) {
      ShadingBatch batch{};
      std::copy_n(distances.data() + at, kFloatBatch, batch.field[kPositionY]);
      light_points(available_isas().front())(program, batch, kBatchPoints);
      for (std::size_t i = 0; i < kFloatBatch; ++i)
        update_worst(worst, ulps(batch.field[kColorR][i], 0x1p-61L / distances[at + i]));
    }
  });
  expect_within("1 / sqrt(x x), x in 2^-60 .. 2^60", worst, 0.5, "ulp");
}

// Half the logarithm of the squared number of texels per pixel. The polynomial is off by less than 1/65536.
// Its sums are below 2^15 and round to 24 bits. Truncating towards the nearest power of four adds or removes
// up to another 1/65536.
TEST(MathFunctions, LevelsOfDetail) {
  long double worst = 0;
  for_floats(bits_of(1) + 1, bits_of(0x1p28f), [&](const std::vector<float>& footprints) {
    std::vector<std::int32_t> levels(footprints.size());
    levels_of_detail(available_isas().front())(footprints.data(), levels.data(), footprints.size());
    for (std::size_t i = 0; i < footprints.size(); ++i)
      update_worst(worst, std::abs(levels[i] - 32768 * std::log2(static_cast<long double>(footprints[i]))));
  });
  expect_within("level of detail of 1 to 16384 texels a pixel", worst, 2.01L, "1/65536 level");
}

// A difference is off by 2^-24 for the rounding of the entry and by its own rounding; three squares and two
// sums round at most three times each. The farther of two entries may be chosen if their squared distances
// differ by less than twice that.
TEST(MathFunctions, PaletteDistances) {
  std::mt19937 random(8);
  long double worst = 0;
  for (const int count : {2, 16, 256}) {
    Palette palette{.bits = 8, .entries = {}};
    for (int i = 0; i < count; ++i)
      palette.entries.push_back({static_cast<std::uint8_t>(random()), static_cast<std::uint8_t>(random()),
                                 static_cast<std::uint8_t>(random())});
    const PaletteSearch search(palette);
    for (int n = 0; n < (long_tests() ? 10000000 : 100000); ++n) {
      // Random colours, and colours nearly halfway between two entries.
      float at[3];
      const Rgb8 a = palette.entries[random() % palette.entries.size()];
      const Rgb8 b = palette.entries[random() % palette.entries.size()];
      const bool between = random() % 2 != 0;
      const double to_b = 0.5 + (random() * 0x1p-32 - 0.5) * 1e-6;
      const auto mixed = [&](int of_a, int of_b) {
        return static_cast<float>(between ? (of_a + (of_b - of_a) * to_b) / 255 : random() * 0x1p-32);
      };
      at[0] = mixed(a.r, b.r);
      at[1] = mixed(a.g, b.g);
      at[2] = mixed(a.b, b.b);
      const auto squared = [&](const Rgb8& e) {
        const long double r = at[0] - e.r / 255.0L;
        const long double g = at[1] - e.g / 255.0L;
        const long double bl = at[2] - e.b / 255.0L;
        return r * r + g * g + bl * bl;
      };
      long double least = 9;
      for (const Rgb8& e : palette.entries) least = std::min(least, squared(e));
      const long double found = squared(palette.entries[search.nearest(at[0], at[1], at[2])]);
      const long double root = std::sqrt(found);
      update_worst(worst,
                   (found - least) / (2 * 0x1p-24L * (2 * std::sqrt(3.0L) * root + 5 * found) + 1e-30L));
    }
  }
  expect_within("squared distance of palette entries beyond the least, error / bound", worst, 1, "");
}

}  // namespace
}  // namespace tessera::test::functions_test
