// Our own powers, logarithms, roots, sines and normalization against results of long double, powers of one exponent of double: the largest error in
// units in the last place (ulp) of what is exact. Powers, logarithms and roots have the same bits on every instruction set, which other tests compare: the fastest is measured.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "framebuffer/palette_search.h"
#include "raster/vertex_transform.h"
#include "shading/lighting.h"
#include "shading/power.h"
#include "shading/trigonometry.h"
#include "tests/numerics/bounds.h"
#include "tests/raster/random_triangles.h"
#include "tests/shading/power_lanes.h"
#include "tests/shading/texture_lanes.h"

namespace tessera::test {
namespace {

/// |found - exact| in ulp of `exact`, a double or a long double within the doubles' normal range.
template <class Real>
Real ulps(float found, Real exact) {
  const Real size = std::abs(exact);
  const auto rounded = static_cast<double>(size);
  const std::uint64_t cut_off = std::bit_cast<std::uint64_t>(rounded) - (rounded > size ? 1 : 0);
  const int exponent = std::max(static_cast<int>(cut_off >> 52) - 1023, -126);
  return std::abs(found - exact) * std::bit_cast<double>(static_cast<std::uint64_t>(1023 + 23 - exponent) << 52);
}

constexpr std::uint32_t kSampled = 2039;  // a prime: no bit of the mantissa stays what it is

/// Floats from the bits `first` to `last`, one in `step` (of 2039: every exponent has some 4100, evenly), and in long runs each; sixteen at a time.
void for_floats(std::uint32_t first, std::uint32_t last, const std::function<void(const std::vector<float>&)>& chunk, std::uint32_t step = kSampled) {
  if (long_tests()) step = 1;
  std::vector<float> floats;
  const auto run = [&] {
    while (floats.size() % 16 != 0) floats.push_back(floats.back());
    chunk(floats);
    floats.clear();
  };
  for (std::uint64_t bits = first; bits <= last; bits += step) {
    floats.push_back(std::bit_cast<float>(static_cast<std::uint32_t>(bits)));
    if (floats.size() == 65536) run();
  }
  floats.push_back(std::bit_cast<float>(last));
  run();
}

using Exact = std::function<long double(float)>;

/// The largest of errors in ulp, and relative to what is exact.
struct Errors {
  long double ulp = 0, relative = 0;
  template <class Real>
  void add(float found, Real exact) {
    ulp = std::max<long double>(ulp, ulps(found, exact));
    relative = std::max<long double>(relative, std::abs(found / exact - 1) * Real{0x1p24});
  }
};

std::vector<float> evaluated(PowerFunction function, float exponent, const std::vector<float>& arguments) {
  std::vector<float> results(arguments.size());
  evaluate_power(available_isas().front())(function, arguments.data(), exponent, results.data(), arguments.size());
  return results;
}

void measure(Errors& errors, PowerFunction function, std::uint32_t first, std::uint32_t last, const Exact& exact) {
  for_floats(first, last, [&](const std::vector<float>& arguments) {
    const std::vector<float> results = evaluated(function, 1, arguments);
    for (std::size_t i = 0; i < arguments.size(); ++i) errors.add(results[i], exact(arguments[i]));
  });
}

std::uint32_t bits_of(float f) { return std::bit_cast<std::uint32_t>(f); }

TEST(Functions, Logarithms) {
  const auto exact = [](float x) { return std::log2(static_cast<long double>(x)); };
  Errors errors;
  // 1 apart: log2(1) is 0, and comes out so.
  measure(errors, PowerFunction::log2, bits_of(kSmallestNormal), bits_of(1) - 1, exact);
  measure(errors, PowerFunction::log2, bits_of(1) + 1, bits_of(3.4028234e38f), exact);
  expect_within("log2(x), normal x", errors.ulp, 1.61, "ulp");
  expect_within("log2(x), normal x, relative", errors.relative, 2.09, "2^-24");
}

TEST(Functions, PowersOfTwo) {
  const auto exact = [](float x) { return std::exp2(static_cast<long double>(x)); };
  Errors errors;
  measure(errors, PowerFunction::exp2, 0, bits_of(kLargestLog2), exact);
  measure(errors, PowerFunction::exp2, bits_of(-0.0f), bits_of(-126.0f), exact);
  expect_within("2^x, x in -126 .. 96", errors.ulp, 1.2, "ulp");
}

/// Errors of powers of x in 0 .. 1, of those of at least 1/256 and of all that are normal floats.
struct PowerErrors {
  Errors visible, any;
  template <class Real>
  void add(float y, const std::vector<float>& arguments) {
    const std::vector<float> results = evaluated(PowerFunction::power, y, arguments);
    for (std::size_t i = 0; i < arguments.size(); ++i) {
      const Real exact = std::pow(static_cast<Real>(arguments[i]), static_cast<Real>(y));
      if (exact < 0x1.02p-126L) continue;  // cut off there
      any.add(results[i], exact);
      if (exact >= 0x1p-8L) visible.add(results[i], exact);
    }
  }
  // p = y log2 x is off by what the logarithm is, 2.09 u of it (u = 2^-24), and by half an ulp of its own, 64 u where |p| is between 64 and 128, 4 u between 4 and 8.
  // 2^p is off by ln 2 times that, and by its own 1.2 ulp, which are no more than 2.4 u: (2.09 * 126 + 64) ln 2 + 2.4 = 229.4, and (2.09 * 8 + 4) ln 2 + 2.4 = 16.8. An ulp
  // is between u and 2 u; where it is u, the share of 2^p's error is 1.2: 228.2 and 15.6.
  void expect(const std::string& power) const {
    expect_within(power + " of at least 1/256, relative", visible.relative, 16.8L, "2^-24");
    expect_within(power + " of at least 1/256", visible.ulp, 15.6L, "ulp");
    expect_within(power + ", relative", any.relative, 229.4L, "2^-24");
    expect_within(power, any.ulp, 228.2L, "ulp");
  }
};

// Exponents are 0 .. 16384. Of the large ones every float near enough to 1 to have a power. A test for each: with TESSERA_LONG one has up to a billion of
// them. So what is exact is a double here, which is off by about 2^-28 of a float's ulp itself.
class FunctionsPowers : public testing::TestWithParam<float> {};
TEST_P(FunctionsPowers, OfOneExponent) {
  const float y = GetParam();
  PowerErrors errors;
  const auto least = std::max(static_cast<float>(std::exp2(-126 / static_cast<double>(y))), kSmallestNormal);
  for_floats(bits_of(least), bits_of(1), [&](const std::vector<float>& arguments) { errors.add<double>(y, arguments); }, y > 5000 ? 1 : y > 500 ? 7 : kSampled);
  errors.expect("x^" + std::to_string(y).substr(0, 5));
}
INSTANTIATE_TEST_SUITE_P(Exponents, FunctionsPowers, testing::Values(0.25f, 0.5f, 2.0f, 20.0f, 128.0f, 1000.0f, 7661.0f, 10000.0f, 16384.0f));

// Exponents evenly in 0 .. 16384 and in their logarithms, and the powers evenly in theirs.
TEST(Functions, PowersOfAnyExponent) {
  std::mt19937 random(9);
  const auto unit = [&] { return static_cast<double>(random()) * 0x1p-32; };
  PowerErrors errors;
  for (int n = 0; n < (long_tests() ? 1000000 : 10000); ++n) {
    const auto y = static_cast<float>(n % 2 == 0 ? 16384 * unit() : std::exp2(28 * unit() - 14));
    std::vector<float> arguments(48);
    for (float& x : arguments) x = std::clamp(static_cast<float>(std::exp2((random() % 4 == 0 ? -8 : -126) * unit() / static_cast<double>(y))), kSmallestNormal, 1.0f);
    errors.add<long double>(y, arguments);
  }
  errors.expect("x^y, y in 0 .. 16384");
}

// Products: x^a x^b is off by what its factors are, a - 1 and b - 1 roundings of u, and by its own.
TEST(Functions, WholePowers) {
  long double share = 0;
  for (int n = 2; n <= kLargestWholePower; ++n)
    for_floats(bits_of(static_cast<float>(std::exp2(-125.98 / n))), bits_of(1), [&](const std::vector<float>& arguments) {
      const std::vector<float> results = evaluated(PowerFunction::chosen, static_cast<float>(n), arguments);
      for (std::size_t i = 0; i < arguments.size(); ++i) {
        const long double exact = std::pow(static_cast<long double>(arguments[i]), static_cast<long double>(n));
        share = std::max(share, std::abs(results[i] / exact - 1) * 0x1p24L / (n - 1));
      }
    }, kSampled * 16);
  expect_within("x^n, n = 2 .. 64, relative", share, 1, "(n - 1) 2^-24");
}

// They have no logarithm of ours: each counts as the smallest normal float. Nothing has the power 0.
TEST(Functions, PowersOfSubnormalFloats) {
  std::vector<float> subnormal{0x1p-149f};
  while (subnormal.size() < 16) subnormal.push_back(std::bit_cast<float>(static_cast<std::uint32_t>(0x7fffff * subnormal.size() / 15)));
  for (const float y : {0x1p-10f, 0.5f, 0.75f, 1.0f, 16384.0f}) {
    const float smallest = evaluated(PowerFunction::power, y, std::vector<float>(16, kSmallestNormal))[0];
    EXPECT_LE(ulps(smallest, std::exp2(std::max(-126.0L * y, -126.0L))), 228.2L) << y;
    EXPECT_EQ(evaluated(PowerFunction::power, y, subnormal), std::vector<float>(16, smallest)) << y;
    EXPECT_EQ(evaluated(PowerFunction::power, y, std::vector<float>(16, 0.0f)), std::vector<float>(16, 0.0f)) << y;
  }
}

TEST(Functions, SinesAndCosines) {
  long double worst = 0;
  std::mt19937 random(5);
  const auto check = [&](double degrees) {
    const long double turn = std::remainder(static_cast<long double>(degrees), 360.0L) * (std::numbers::pi_v<long double> / 180);
    const SinCos found = sin_cos_degrees(degrees);
    worst = std::max({worst, std::abs(found.sine - std::sin(turn)), std::abs(found.cosine - std::cos(turn))});
  };
  for (int i = -720 * 1024; i <= 720 * 1024; ++i) check(i / 1024.0);
  for (int i = 0; i < 1000000; ++i) check(std::ldexp(static_cast<double>(random()) - 0x1p31, static_cast<int>(random() % 64) - 40));
  expect_within("sine and cosine of degrees, absolute", worst, 1e-15L, "");
  for (int quarter = -8; quarter <= 8; ++quarter) {
    const SinCos found = sin_cos_degrees(90.0 * quarter);
    constexpr double kSines[] = {0, 1, 0, -1};
    EXPECT_EQ(found.sine, kSines[quarter & 3]);
    EXPECT_EQ(found.cosine, kSines[(quarter + 1) & 3]);
  }
}

/// Two more components for each first one: of about its size, or much smaller, at most `largest`.
struct Vectors {
  std::vector<float> xyz;
  Vectors(const std::vector<float>& first, double smallest, double largest, std::mt19937& random) {
    for (const float x : first) {
      xyz.push_back(x);
      for (int k = 0; k < 2; ++k) {
        const double other = x * std::ldexp(1 + random() * 0x1p-32, 1 - static_cast<int>(random() % 40));
        xyz.push_back(static_cast<float>(std::clamp(random() % 16 == 0 ? 0 : other, smallest, largest)));
      }
    }
  }
  long double unit(std::size_t i, std::size_t k) const {
    const long double x = xyz[3 * i], y = xyz[3 * i + 1], z = xyz[3 * i + 2];
    return xyz[3 * i + k] / std::sqrt(x * x + y * y + z * z);
  }
};

// In double, so that squares of all floats are numbers: 3.5 roundings of 2^-53 before the one to a float.
TEST(Functions, NormalsOfVertices) {
  std::mt19937 random(6);
  long double worst = 0;
  EyeTransform transform;
  for (int k = 0; k < 3; ++k) transform.normal_matrix[4 * k] = 1;
  for_floats(1, bits_of(3.4028234e38f), [&](const std::vector<float>& first) {
    const Vectors vectors(first, 0, 3.4028234e38, random);
    for (std::size_t at = 0; at < first.size(); at += 16) {
      float unit[3][kVertexBatch];
      eye_normals(available_isas().front())(transform, {vectors.xyz.data() + 3 * at, 3}, 16, unit[0], unit[1], unit[2]);
      for (std::size_t i = 0; i < 16; ++i)
        for (std::size_t k = 0; k < 3; ++k)
          if (vectors.xyz[3 * (at + i) + k] != 0) worst = std::max(worst, ulps(unit[k][i], vectors.unit(at + i, k)));
    }
  });
  expect_within("normalize at vertices, every float", worst, 0.50001L, "ulp");
}

/// A program of lights along x, y and z, whose diffuse parts are what the points' normals are, in red, green and blue.
LightingProgram normals_as_colors() {
  std::vector<EyeLight> lights(3);
  for (std::size_t k = 0; k < 3; ++k) {
    lights[k].position = lights[k].diffuse = lights[k].specular = {0, 0, 0};
    lights[k].position[k] = lights[k].diffuse[k] = 1;
  }
  LightingProgram program = plan_lighting({.ambient = {0, 0, 0}, .diffuse = {1, 1, 1}}, {}, lights, {.scene_ambient = {0, 0, 0}}, nullptr);
  program.renormalize = true;
  return program;
}

// In floats: of the squared length 3 roundings, half of which stay; of the root, its reciprocal and the product one each.
TEST(Functions, NormalsOfPixels) {
  std::mt19937 random(7);
  long double worst = 0;
  const LightingProgram program = normals_as_colors();
  for_floats(bits_of(0x1p-60f), bits_of(0x1p60f), [&](const std::vector<float>& first) {
    const Vectors vectors(first, 0, 0x1p60, random);
    for (std::size_t at = 0; at < first.size(); at += 16) {
      ShadingBatch batch{};
      for (std::size_t i = 0; i < 16; ++i)
        for (std::size_t k = 0; k < 3; ++k) batch.field[kNormalX + k][i] = vectors.xyz[3 * (at + i) + k];
      light_points(available_isas().front())(program, batch, 16);
      for (std::size_t i = 0; i < 16; ++i)
        for (std::size_t k = 0; k < 3; ++k)
          if (vectors.xyz[3 * (at + i) + k] != 0) worst = std::max(worst, std::min<long double>(ulps(batch.field[kColorR + k][i], vectors.unit(at + i, k)), 1e9L));
    }
  });
  expect_within("normalize at pixels, lengths of 2^-60 to 2^60", worst, 4.5, "ulp");
}

// The root of a rounded square is the number itself, and its reciprocal is rounded once.
TEST(Functions, Reciprocals) {
  long double worst = 0;
  EyeLight light{.ambient = {0x1p-61f, 0, 0}, .diffuse = {0, 0, 0}, .specular = {0, 0, 0}};
  light.directional = false;
  light.position = {0, 0, 0};
  light.attenuation = {0, 1, 0};
  const LightingProgram program = plan_lighting({.ambient = {1, 0, 0}, .diffuse = {0, 0, 0}}, {}, {light}, {.scene_ambient = {0, 0, 0}}, nullptr);
  for_floats(bits_of(0x1p-60f), bits_of(0x1p60f), [&](const std::vector<float>& distances) {
    for (std::size_t at = 0; at < distances.size(); at += 16) {
      ShadingBatch batch{};
      std::copy_n(distances.data() + at, 16, batch.field[kPositionY]);
      light_points(available_isas().front())(program, batch, 16);
      for (std::size_t i = 0; i < 16; ++i) worst = std::max(worst, ulps(batch.field[kColorR][i], 0x1p-61L / distances[at + i]));
    }
  });
  expect_within("1 / sqrt(x x), x in 2^-60 .. 2^60", worst, 0.5, "ulp");
}

// Half the logarithm of how many texels a pixel spans, squared: the polynomial is off by less than 1/65536, its sums round at less than 2^15 with 24 bits,
// and truncating towards the nearest power of four takes or adds up to another 1/65536.
TEST(Functions, LevelsOfDetail) {
  long double worst = 0;
  for_floats(bits_of(1) + 1, bits_of(0x1p28f), [&](const std::vector<float>& footprints) {
    std::vector<std::int32_t> levels(footprints.size());
    levels_of_detail(available_isas().front())(footprints.data(), levels.data(), footprints.size());
    for (std::size_t i = 0; i < footprints.size(); ++i) worst = std::max(worst, std::abs(levels[i] - 32768 * std::log2(static_cast<long double>(footprints[i]))));
  });
  expect_within("level of detail of 1 to 16384 texels a pixel", worst, 2.01L, "1/65536 level");
}

// A difference is off by 2^-24 for the entry's own rounding and one of its own; three squares and two sums round at most three times each: of two entries
// the farther one may be taken where their squared distances differ by less than twice that.
TEST(Functions, PaletteDistances) {
  std::mt19937 random(8);
  long double worst = 0;
  for (const int count : {2, 16, 256}) {
    Palette palette{.bits = 8, .entries = {}};
    for (int i = 0; i < count; ++i) palette.entries.push_back({static_cast<std::uint8_t>(random()), static_cast<std::uint8_t>(random()), static_cast<std::uint8_t>(random())});
    const PaletteSearch search(palette);
    for (int n = 0; n < (long_tests() ? 10000000 : 100000); ++n) {
      // Anywhere, or nearly half way between two entries.
      float at[3];
      const Rgb8 a = palette.entries[random() % palette.entries.size()], b = palette.entries[random() % palette.entries.size()];
      const bool between = random() % 2 != 0;
      const double to_b = 0.5 + (random() * 0x1p-32 - 0.5) * 1e-6;
      const auto mixed = [&](int of_a, int of_b) { return static_cast<float>(between ? (of_a + (of_b - of_a) * to_b) / 255 : random() * 0x1p-32); };
      at[0] = mixed(a.r, b.r), at[1] = mixed(a.g, b.g), at[2] = mixed(a.b, b.b);
      const auto squared = [&](const Rgb8& e) {
        const long double r = at[0] - e.r / 255.0L, g = at[1] - e.g / 255.0L, bl = at[2] - e.b / 255.0L;
        return r * r + g * g + bl * bl;
      };
      long double least = 9;
      for (const Rgb8& e : palette.entries) least = std::min(least, squared(e));
      const long double found = squared(palette.entries[search.nearest(at[0], at[1], at[2])]), root = std::sqrt(found);
      worst = std::max(worst, (found - least) / (2 * 0x1p-24L * (2 * std::sqrt(3.0L) * root + 5 * found) + 1e-30L));
    }
  }
  expect_within("squared distance of palette entries beyond the least, of its roundings", worst, 1, "");
}

}  // namespace
}  // namespace tessera::test
