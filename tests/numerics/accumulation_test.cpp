// Accumulation buffer through whole frames, against exact integer quotients: the rounding of each command,
// the loss over 256 passes, and saturation at the ends of the range.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "tests/numerics/bounds.h"
#include "tests/numerics/color_components.h"
#include "tests/numerics/exact.h"
#include "tests/raster/random_triangles.h"

namespace tessera::test::accumulation_test {
namespace {

constexpr int kWidth = 64, kHeight = 16;

std::int64_t one_of(int bits) { return bits == 16 ? 32767 : 2147483647; }
std::int64_t saturated(Int128 level, int bits) {
  return static_cast<std::int64_t>(std::clamp<Int128>(level, -Int128{one_of(bits)} - 1, one_of(bits)));
}

FrameBufferFormat format_of(int color_bits, int bits) {
  return {.width = kWidth,
          .height = kHeight,
          .color_bits = color_bits,
          .depth = DepthFormat::none,
          .stencil_bits = 0,
          .alpha_bits = color_bits % 2 == 0 ? 8 : 0,
          .accumulation_bits = bits};
}

/// An image with random 8-bit components.
struct Picture {
  std::vector<std::uint8_t> texels;

  template <class Level>
  explicit Picture(const Level& level) {
    for (int i = 0; i < 4 * kWidth * kHeight; ++i) texels.push_back(static_cast<std::uint8_t>(level(i)));
  }
  void draw(Frame& frame) const {
    frame.draw_image({.pixels = texels.data(), .width = kWidth, .height = kHeight});
  }
};

/// Expected result of a command for one component: (stored level, colour level) -> exact value in
/// accumulation levels.
using Exact = std::function<Ratio(std::int64_t level, std::int64_t color, std::int64_t levels_of_color)>;

// Error beyond half a level. Each command rounds once, to the nearest level. Its products are computed in
// double with three roundings of 2^-53; unless they saturate, products are below 2^33 levels at 32 bits and
// below 2^17 at 16 bits.
long double beyond_half(int bits) { return 3 * std::ldexp(1.0L, (bits == 16 ? 17 : 33) - 53); }

class Commands {
 public:
  Commands(int color_bits, int bits)
      : buffer_(format_of(color_bits, bits)), frame_(buffer_), split_(buffer_.format()), bits_(bits) {}

  void paint(Picture picture) {
    painted_.push_back(std::move(picture));  // Borrowed until the frame is finished.
    painted_.back().draw(frame_);
  }
  /// Runs the command and raises `worst` to the largest distance from the expected result.
  void run(const Accum& accum, const Exact& exact, long double& worst) {
    renderer_.finish(frame_);
    painted_.clear();
    const auto before = accumulation_levels(buffer_);
    frame_.accumulate(accum);
    renderer_.finish(frame_);
    const auto after = accumulation_levels(buffer_);
    const auto words = packed_colors(buffer_);
    for (std::size_t i = 0; i < words.size(); ++i)
      for (std::size_t c = 0; c < 4; ++c) {
        const bool has = split_.bits[c] > 0;
        const Ratio value =
            exact(before[i][c], has ? split_.level(words[i], c) : 1, has ? split_.levels(c) : 1);
        const std::int64_t nearest = saturated(value.rounded(), bits_);
        const bool is_saturated = nearest != value.rounded();
        if (is_saturated && after[i][c] != nearest)
          ADD_FAILURE() << "saturated to " << after[i][c] << ", expected " << nearest;
        if (!is_saturated) update_worst(worst, value.distance(after[i][c]));
      }
  }
  Frame& frame() { return frame_; }
  FrameBuffer& buffer() { return buffer_; }
  Renderer& renderer() { return renderer_; }
  const ComponentBits& split() const { return split_; }

 private:
  FrameBuffer buffer_;
  std::vector<Picture> painted_;
  Renderer renderer_{{.threads = 1}};
  Frame frame_;
  ComponentBits split_;
  int bits_;
};

TEST(NumericsAccumulation, EachCommandRoundsOnce) {
  for (const int bits : {16, 32}) {
    long double worst = 0;
    for (const int color_bits : {1, 2, 3, 8, 15, 16, 23, 24}) {
      Random random(static_cast<std::uint64_t>(color_bits));
      Commands commands(color_bits, bits);
      for (int turn = 0; turn < (long_tests() ? 2000 : 60); ++turn) {
        const double one = static_cast<double>(one_of(bits));
        const double values[] = {1 / 256.0,
                                 random.between(-1, 1),
                                 -1,
                                 1,
                                 random.between(-3, 3),
                                 1.5 * (turn % 3),
                                 0.5 / one,
                                 1.5 / one,
                                 -0.5 / one,
                                 1e6,
                                 -1e6};
        const double value = values[random.next() % std::size(values)];
        const Ratio v = Ratio::of(value);
        const std::int64_t whole = one_of(bits);
        if (turn % 3 == 0) commands.paint(Picture([&](int) { return random.next() % 256; }));
        switch (random.next() % 4) {
          case 0:
            commands.run(
                {.op = AccumOp::load, .value = value},
                [&](auto, auto color, auto levels) { return v * (color * whole) / levels; }, worst);
            break;
          case 1:
            commands.run(
                {.op = AccumOp::accum, .value = value},
                [&](auto level, auto color, auto levels) {
                  const Ratio term = v * (color * whole) / levels;
                  return Ratio{term.numerator + level * term.denominator, term.denominator};
                },
                worst);
            break;
          case 2:
            commands.run(
                {.op = AccumOp::add, .value = value},
                [&](auto level, auto, auto) {
                  return Ratio{v.numerator * whole + level * v.denominator, v.denominator};
                },
                worst);
            break;
          default:
            commands.run(
                {.op = AccumOp::mult, .value = value}, [&](auto level, auto, auto) { return v * level; },
                worst);
            break;
        }
        if (HasFailure()) return;
      }
    }
    EXPECT_GT(worst, 0.49L) << "no test value near the middle of two levels";
    expect_within("accumulation, one command, " + std::to_string(bits) + " bits, beyond half a level",
                  std::max(0.0L, worst - 0.5L), beyond_half(bits), "levels of accumulation");
  }
}

// 256 roundings of half a level of 2^15 or 2^31 may add up to colour levels: 256 / 2 / 32767 of 1.0 is 0.996
// levels of 255.
TEST(NumericsAccumulation, Over256PassesLosesAtMostOneLevelAt16BitsAndNoneAt32) {
  for (const int bits : {16, 32}) {
    long double worst = 0;
    for (int color_bits = 1; color_bits <= 24; ++color_bits)
      for (const bool in_one_frame : {true, false}) {
        if (!in_one_frame && color_bits % 8 != 0) continue;
        Commands commands(color_bits, bits);
        commands.paint(Picture([](int i) { return i / 4; }));
        commands.renderer().finish(commands.frame());
        const auto before = packed_colors(commands.buffer());
        for (int pass = 0; pass < 256; ++pass) {
          commands.frame().accumulate({.op = pass == 0 ? AccumOp::load : AccumOp::accum, .value = 1 / 256.0});
          if (!in_one_frame) commands.renderer().finish(commands.frame());
        }
        commands.renderer().finish(commands.frame());
        const auto sums = accumulation_levels(commands.buffer());
        commands.frame().clear({.color = Color{0, 0, 0, 0}});
        commands.frame().accumulate({.op = AccumOp::return_color});
        commands.renderer().finish(commands.frame());
        const auto after = packed_colors(commands.buffer());
        const ComponentBits& split = commands.split();
        for (std::size_t i = 0; i < before.size(); ++i)
          for (std::size_t c = 0; c < 4; ++c) {
            const bool has = split.bits[c] > 0;
            const std::int64_t level = has ? split.level(before[i], c) : 1;
            const std::int64_t levels = has ? split.levels(c) : 1;
            ASSERT_EQ(sums[i][c],
                      saturated(256 * (Ratio{level * one_of(bits), 256 * levels}.rounded()), bits))
                << "level " << level << " of " << levels;
            update_worst(worst, std::abs(split.level(after[i], c) - split.level(before[i], c)));
          }
      }
    expect_within("accumulation, 256 passes of 1/256, " + std::to_string(bits) + " bits", worst,
                  bits == 16 ? 1 : 0, "levels of the colour");
  }
}

// 256 different pictures: the result is the level nearest to their mean, within the rounding of the passes.
TEST(NumericsAccumulation, AveragesOf256PicturesMatchTheirMean) {
  for (const int bits : {16, 32}) {
    long double worst = 0;
    for (const int color_bits : {3, 16, 24}) {
      Random random(5);
      Commands commands(color_bits, bits);
      const ComponentBits& split = commands.split();
      std::vector<std::array<std::int64_t, 4>> sums(std::size_t{kWidth} * kHeight);
      for (int pass = 0; pass < 256; ++pass) {
        commands.paint(Picture([&](int) { return random.next() % 256; }));
        commands.frame().accumulate({.op = pass == 0 ? AccumOp::load : AccumOp::accum, .value = 1 / 256.0});
        commands.renderer().finish(commands.frame());
        const auto words = packed_colors(commands.buffer());
        for (std::size_t i = 0; i < words.size(); ++i)
          for (std::size_t c = 0; c < 4; ++c) sums[i][c] += split.level(words[i], c);
      }
      commands.frame().accumulate({.op = AccumOp::return_color});
      commands.renderer().finish(commands.frame());
      const auto after = packed_colors(commands.buffer());
      for (std::size_t i = 0; i < after.size(); ++i)
        for (std::size_t c = 0; c < 4; ++c)
          if (split.bits[c] > 0)
            update_worst(worst, Ratio{sums[i][c], 256}.distance(split.level(after[i], c)));
    }
    // Half a level of the final rounding plus 256 half levels of the passes (each 0.5 / 32767 or 0.5 / (2^31
    // - 1) of 1.0, times 255 levels).
    expect_within("accumulation, mean of 256 pictures, " + std::to_string(bits) + " bits", worst,
                  0.5L + 128 * 255.0L / static_cast<long double>(one_of(bits)) + 0x1p-40L, "levels of 255");
  }
}

// Every level of 16 bits, and as many levels of 32 bits, returns the nearest colour level.
TEST(NumericsAccumulation, ReturnsTheNearestColorLevel) {
  constexpr int kSide = 256;
  for (const int bits : {16, 32})
    for (int color_bits = 1; color_bits <= 24; ++color_bits) {
      FrameBufferFormat format = format_of(color_bits, bits);
      format.width = format.height = kSide;
      FrameBuffer buffer(format);
      Frame frame(buffer);
      Renderer renderer({.threads = 1});
      // The level of a pixel is the sum of a row term, a column term and a small term per component.
      const double step = 1.0 / static_cast<double>(one_of(16));
      for (int i = 0; i < kSide; ++i) {
        frame.accumulate(
            {.op = AccumOp::add, .value = (256 * i - 32768) * step, .scissor = Rect{0, i, kSide, 1}});
        frame.accumulate({.op = AccumOp::add, .value = i * step, .scissor = Rect{i, 0, 1, kSide}});
      }
      renderer.finish(frame);
      const auto levels = accumulation_levels(buffer);
      const ComponentBits split(format);
      for (const double value :
           {1.0, std::array{0.37, -1.0, 2.5}[static_cast<std::size_t>(color_bits % 3)]}) {
        frame.accumulate({.op = AccumOp::return_color, .value = value});
        renderer.finish(frame);
        const auto words = packed_colors(buffer);
        long double worst = 0;
        for (std::size_t i = 0; i < words.size(); ++i)
          for (std::size_t c = 0; c < 4; ++c) {
            if (split.bits[c] == 0) continue;
            // All components hold the same level, so the luminance equals it.
            const Ratio exact = Ratio::of(value) * (levels[i][c] * split.levels(c)) / one_of(bits);
            const std::int64_t most = split.levels(c);
            Ratio clamped = exact;
            if (exact.numerator <= 0) clamped = Ratio{};
            if (exact.numerator >= most * exact.denominator) clamped = Ratio{most, 1};
            update_worst(worst, clamped.distance(split.level(words[i], c)));
          }
        // Computed in double, except for the three luminance weights, which are floats: off by at most 2^-26,
        // 2^-25 and 2^-28.
        const long double beyond = std::max(0.0L, worst - 0.5L);
        const long double bound = (color_bits <= 2 ? 3 * 13 * 0x1p-28L : 0) + 255 * 4 * 0x1p-53L;
        EXPECT_LE(beyond, bound) << color_bits << " colour bits, " << bits << " bits";
        if (color_bits == 24 && value == 1)
          expect_within("accumulation, return, " + std::to_string(bits) + " bits, beyond half a level",
                        beyond, bound, "levels of 255");
      }
    }
}

}  // namespace
}  // namespace tessera::test::accumulation_test
