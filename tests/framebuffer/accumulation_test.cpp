// Accumulation buffer arithmetic against a long double reference for one component.
#include "framebuffer/accumulation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace tessera::detail::accumulation_test {
namespace {

using Op = AccumOp;

long double one(int bits) { return bits == 16 ? 32767.0L : 2147483647.0L; }

std::int32_t rounded(long double level, int bits) {
  return static_cast<std::int32_t>(std::clamp(std::floor(level + 0.5L), -one(bits) - 1, one(bits)));
}

std::int32_t expected(Op op, double value, std::int32_t acc, long double color, int bits) {
  switch (op) {
    case Op::accum: return rounded(acc + value * color * one(bits), bits);
    case Op::load: return rounded(value * color * one(bits), bits);
    case Op::add: return rounded(acc + value * one(bits), bits);
    default: return rounded(acc * static_cast<long double>(value), bits);
  }
}

// Components r, g, b, a of a packed colour.
std::array<long double, 4> color_of(std::uint32_t packed, const ColorLayout& layout) {
  const auto field = [&](int shift, int bits) {
    return static_cast<long double>(packed >> shift & ((1u << bits) - 1)) / ((1u << bits) - 1);
  };
  const long double alpha = layout.alpha_bits == 0 ? 1 : field(layout.bits, layout.alpha_bits);
  if (layout.luminance) return {field(0, layout.bits), field(0, layout.bits), field(0, layout.bits), alpha};
  return {field(layout.r_shift(), layout.r_bits), field(layout.g_shift(), layout.g_bits),
          field(0, layout.b_bits), alpha};
}

std::uint32_t expected_packed(double value, const AccumulatedPixel& acc, int bits, const ColorLayout& layout,
                              long double threshold) {
  std::array<long double, 4> c;
  for (std::size_t i = 0; i < 4; ++i) c[i] = std::clamp(value * (acc[i] / one(bits)), 0.0L, 1.0L);
  const auto level = [&](long double x, int b) {
    return static_cast<std::uint32_t>(std::floor(x * ((1 << b) - 1) + threshold));
  };
  const std::uint32_t alpha = layout.alpha_bits == 0 ? 0 : level(c[3], layout.alpha_bits) << layout.bits;
  if (layout.luminance)
    return alpha | level(std::min(0.30L * c[0] + 0.59L * c[1] + 0.11L * c[2], 1.0L), layout.bits);
  return alpha | level(c[0], layout.r_bits) << layout.r_shift() |
         level(c[1], layout.g_bits) << layout.g_shift() | level(c[2], layout.b_bits);
}

std::vector<ColorLayout> layouts() {
  std::vector<ColorLayout> all;
  for (int bits = 1; bits <= 24; ++bits)
    for (const int alpha_bits : {0, 8}) {
      all.push_back(rgb_layout(bits));
      all.back().alpha_bits = alpha_bits;
    }
  return all;
}

std::uint32_t next_random() {
  static std::uint32_t state = 12345;
  return state = state * 1664525u + 1013904223u, state ^ state >> 15;
}

// Values with many digits, so that no product falls on a half.
constexpr double kValues[] = {1,    -1,   0,     0.2987654321, -0.7123456789, 1 / 256.0, -2.4987654321,
                              1e-9, 1e20, -1e300};

// Levels at and near the ends of the range, near 0, and random.
std::vector<AccumulatedPixel> levels_of(int bits) {
  const auto max = static_cast<std::int32_t>(one(bits));
  std::vector<AccumulatedPixel> pixels{
      {max, -max - 1, 0, 1}, {-1, max - 1, -max, max / 2}, {max / 3, -max / 3, 2, -2}};
  for (int i = 0; i < 60; ++i) {
    AccumulatedPixel pixel;
    for (std::int32_t& level : pixel) level = accumulation_level_from_stored(next_random(), bits);
    pixels.push_back(pixel);
  }
  return pixels;
}

TEST(AccumulationArithmetic, MatchesLongDoubleForEveryDepthOpAndSign) {
  int low_ends = 0, high_ends = 0;
  for (const int bits : {16, 32})
    for (const ColorLayout& layout : layouts())
      for (const Op op : {Op::accum, Op::load, Op::add, Op::mult})
        for (const double value : kValues) {
          const Accumulation accumulation(op, value, bits, layout);
          const std::vector<AccumulatedPixel> before = levels_of(bits);
          const int count = static_cast<int>(before.size());
          std::vector<std::uint32_t> packed_colors;
          std::array<std::vector<std::int32_t>, 4> after;
          for (const AccumulatedPixel& pixel : before) {
            packed_colors.push_back(next_random());  // bits beyond the planes must be ignored
            for (std::size_t c = 0; c < 4; ++c) after[c].push_back(pixel[c]);
          }
          accumulation.run(packed_colors.data(),
                           {after[0].data(), after[1].data(), after[2].data(), after[3].data()}, count);
          for (std::size_t i = 0; i < before.size(); ++i)
            for (std::size_t c = 0; c < 4; ++c) {
              const std::int32_t wanted =
                  expected(op, value, before[i][c], color_of(packed_colors[i], layout)[c], bits);
              ASSERT_EQ(after[c][i], wanted)
                  << bits << " bits, colour " << layout.bits << "+" << layout.alpha_bits << ", op " << int(op)
                  << ", value " << value << ", component " << c << ", before " << before[i][c] << ", packed "
                  << packed_colors[i];
              low_ends += wanted == -one(bits) - 1;
              high_ends += wanted == one(bits);
            }
        }
  EXPECT_GT(low_ends, 1000);
  EXPECT_GT(high_ends, 1000);
}

TEST(AccumulationArithmetic, ReturnMatchesLongDouble) {
  int differing = 0, all = 0;
  for (const int bits : {16, 32})
    for (const ColorLayout& layout : layouts())
      for (const double value : kValues)
        for (const AccumulatedPixel& pixel : levels_of(bits))
          for (const auto& [x, y] : {std::pair{-1, 0}, {0, 7}, {7, 0}}) {
            // The lowest and the highest threshold of bayer8; without dither 0.5.
            const ColorDither dither(Dither::bayer8, std::nullopt, layout, {}, 8);
            const double threshold = x < 0 ? 0.5 : x == 0 ? 0.0078125 : dither.pattern().at(x, y);
            const std::uint32_t packed = Accumulation(Op::return_color, value, bits, layout)
                                             .packed_color(pixel, x < 0 ? nullptr : &dither, x, y);
            ASSERT_EQ(packed & ~(layout.value_mask() | layout.alpha_mask()), 0u);
            differing += packed != expected_packed(value, pixel, bits, layout, threshold);
            ++all;
          }
  EXPECT_EQ(differing, 0) << "of " << all;
}

TEST(AccumulationArithmetic, RoundsHalvesUp) {
  // 32767 * 0.5 = 16383.5; -16383.5 rounds up to -16383.
  EXPECT_EQ(accumulation_level(0.5, 16), 16384);
  EXPECT_EQ(accumulation_level(-0.5, 16), -16383);
  EXPECT_EQ(accumulation_level(1, 32), 2147483647);
  EXPECT_EQ(accumulation_level(-1, 32), -2147483647);
  EXPECT_EQ(accumulation_level(7, 32), 2147483647);
  EXPECT_EQ(accumulation_level(-7, 16), -32768);
}

// Largest error, in levels of 8 bits, after 256 passes of weight 1/256 and a return.
int largest_loss(int bits) {
  const ColorLayout layout = rgb_layout(24);
  const Accumulation accumulate(Op::accum, 1 / 256.0, bits, layout);
  const Accumulation return_color(Op::return_color, 1, bits, layout);
  int loss = 0;
  for (std::uint32_t level = 0; level < 256; ++level) {
    const std::uint32_t packed = level * 0x010101u;
    AccumulatedPixel acc{};
    for (int pass = 0; pass < 256; ++pass) accumulate.run(&packed, {&acc[0], &acc[1], &acc[2], &acc[3]}, 1);
    const std::uint32_t back = return_color.packed_color(acc, nullptr, 0, 0);
    EXPECT_EQ(back, (back & 255) * 0x010101u) << "components differ";
    loss = std::max(loss, std::abs(static_cast<int>(back & 255) - static_cast<int>(level)));
  }
  return loss;
}

TEST(AccumulationArithmetic, LosesAtMostOneLevelIn256PassesAt16BitsAndNoneAt32) {
  EXPECT_LE(largest_loss(16), 1);
  EXPECT_EQ(largest_loss(32), 0);
}

}  // namespace
}  // namespace tessera::detail::accumulation_test
