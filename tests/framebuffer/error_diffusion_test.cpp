// Error diffusion, compared with a plain one in double precision, and its invariants.
#include "framebuffer/error_diffusion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "framebuffer/color_dither.h"

namespace tessera::detail::error_diffusion_test {
namespace {

using Words = std::vector<std::uint32_t>;
using Triple = std::array<double, 3>;

struct Case {
  Dither kind = Dither::floyd_steinberg;
  ColorLayout stored;
  Palette palette;
  std::optional<LightCurve> light;
};

Words diffused(const Case& c, const Words& words, int width) {
  ErrorDiffusion diffusion(
      {.kind = c.kind, .stored = c.stored, .palette = &c.palette, .light = c.light, .width = width});
  Words stored(words.size());
  diffusion.begin_picture();
  for (std::size_t at = 0; at < words.size(); at += static_cast<std::size_t>(width))
    diffusion.row(words.data() + at, stored.data() + at);
  return stored;
}

/// A smooth picture with noise, in which errors take all values.
Words picture(int width, int height, std::uint32_t seed) {
  std::mt19937 random(seed);
  Words words;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const auto noise = [&] { return static_cast<int>(random() % 40); };
      const auto r = static_cast<std::uint32_t>(std::min(255, 200 * x / width + noise()));
      const auto g = static_cast<std::uint32_t>(std::min(255, 200 * y / height + noise()));
      const auto b = static_cast<std::uint32_t>(std::min(255, 100 + noise()));
      words.push_back(r << 16 | g << 8 | b);
    }
  return words;
}

double light_of(double c, const std::optional<LightCurve>& light) { return light ? light->light(c) : c; }

/// Value of a stored component.
double level_value(std::uint32_t level, int bits, const std::optional<LightCurve>& light) {
  return light_of(static_cast<double>(level) / ((1 << bits) - 1), light);
}

/// Level of b bits whose value is nearest.
std::uint32_t nearest_level(double wanted, int bits, const std::optional<LightCurve>& light) {
  std::uint32_t nearest = 0;
  for (std::uint32_t level = 1; level < 1u << bits; ++level)
    if (std::abs(level_value(level, bits, light) - wanted) <
        std::abs(level_value(nearest, bits, light) - wanted))
      nearest = level;
  return nearest;
}

/// One component of a picture, by the textbook.
Words plain_component(const Words& words, int width, int shift, int bits, const Case& c) {
  const int height = static_cast<int>(words.size()) / width;
  std::vector<double> value;
  for (const std::uint32_t word : words) value.push_back(light_of((word >> shift & 255) / 255.0, c.light));
  Words levels(words.size());
  for (int y = 0; y < height; ++y)
    for (int i = 0; i < width; ++i) {
      const int direction = y % 2 == 0 ? 1 : -1;
      const int x = direction > 0 ? i : width - 1 - i;
      const auto at = static_cast<std::size_t>(y * width + x);
      levels[at] = nearest_level(value[at], bits, c.light);
      const double error = value[at] - level_value(levels[at], bits, c.light);
      const auto give = [&](int dx, int dy, double share) {
        int to_x = x + direction * dx, to_y = y + dy;
        const bool is_outside = to_x < 0 || to_x >= width;
        if (is_outside && dy == 0) ++to_y, to_x = x + (i + 1 < width ? direction : 0);
        to_x = std::clamp(to_x, 0, width - 1);
        if (to_y < height) value[static_cast<std::size_t>(to_y * width + to_x)] += error * share;
      };
      if (c.kind == Dither::floyd_steinberg) {
        give(1, 0, 7 / 16.0), give(-1, 1, 3 / 16.0), give(0, 1, 5 / 16.0), give(1, 1, 1 / 16.0);
      } else {
        give(1, 0, 7 / 48.0), give(2, 0, 5 / 48.0);
        const int rows[2][5] = {{3, 5, 7, 5, 3}, {1, 3, 5, 3, 1}};
        for (int dy = 1; dy <= 2; ++dy)
          for (int dx = -2; dx <= 2; ++dx) give(dx, dy, rows[dy - 1][dx + 2] / 48.0);
      }
    }
  return levels;
}

// Sums in another order can round a tie differently, and the difference spreads: pictures of 24 rows have
// few.
TEST(ErrorDiffusion, MatchesTheTextbook) {
  constexpr int kWidth = 37, kHeight = 24;
  const Words words = picture(kWidth, kHeight, 3);
  for (const Dither kind : {Dither::floyd_steinberg, Dither::jarvis})
    for (const std::optional<LightCurve>& light : {std::optional<LightCurve>{}, {LightCurve{2.2}}})
      for (const int bits : {3, 8, 12, 15}) {
        const Case c{.kind = kind, .stored = rgb_layout(bits), .palette = {}, .light = light};
        const Words stored = diffused(c, words, kWidth);
        const ColorLayout& layout = c.stored;
        int differing = 0;
        const auto compare = [&](int from, int shift, int component_bits) {
          const Words wanted = plain_component(words, kWidth, from, component_bits, c);
          for (std::size_t i = 0; i < words.size(); ++i)
            differing += (stored[i] >> shift & ((1u << component_bits) - 1)) != wanted[i];
        };
        compare(16, layout.r_shift(), layout.r_bits);
        compare(8, layout.g_shift(), layout.g_bits);
        compare(0, 0, layout.b_bits);
        EXPECT_LE(differing, 3) << bits << " bits, kind " << static_cast<int>(kind) << ", light "
                                << light.has_value();
      }
}

TEST(ErrorDiffusion, KeepsTheMeanOfMixedPaletteEntries) {
  const Palette palette{.bits = 2, .entries = {{0, 0, 0}, {255, 0, 0}, {0, 255, 0}, {0, 0, 255}}};
  for (const Dither kind : {Dither::floyd_steinberg, Dither::jarvis}) {
    const Case c{.kind = kind, .stored = index_layout(2), .palette = palette, .light = std::nullopt};
    const Words stored = diffused(c, Words(64 * 64, 0x402060), 64);
    Triple sum{};
    for (const std::uint32_t index : stored) {
      ASSERT_LT(index, 4u);
      if (index > 0) sum[index - 1] += 1;
    }
    EXPECT_NEAR(sum[0] / 4096, 0x40 / 255.0, 1 / 128.0);
    EXPECT_NEAR(sum[1] / 4096, 0x20 / 255.0, 1 / 128.0);
    EXPECT_NEAR(sum[2] / 4096, 0x60 / 255.0, 1 / 128.0);
  }
}

TEST(ErrorDiffusion, IndicesStayAndSeparateTheirNeighbours) {
  constexpr int kWidth = 16;
  const Case c{
      .kind = Dither::jarvis, .stored = index_layout(4), .palette = default_palette_of(4), .light = {}};
  const std::uint32_t flag = working_layout(c.stored).index_flag();
  ASSERT_NE(flag, 0u);
  // Two rows of indices: no share reaches beyond them.
  Words words = picture(kWidth, 12, 7);
  for (std::size_t i = 5 * kWidth; i < 7 * kWidth; ++i) words[i] = flag | i % 16;
  Words other = words;
  for (std::size_t i = 0; i < 5 * kWidth; ++i) other[i] = 0x345678;
  const Words a = diffused(c, words, kWidth), b = diffused(c, other, kWidth);
  for (std::size_t i = 5 * kWidth; i < 7 * kWidth; ++i) EXPECT_EQ(a[i], i % 16);
  EXPECT_NE(Words(a.begin(), a.begin() + 5 * kWidth), Words(b.begin(), b.begin() + 5 * kWidth));
  EXPECT_EQ(Words(a.begin() + 7 * kWidth, a.end()), Words(b.begin() + 7 * kWidth, b.end()));
}

TEST(ErrorDiffusion, SharesPassOverAnIndex) {
  // 115 / 255 becomes black. 5/48 of its error makes 117 / 255, two pixels on, white.
  const Case c{
      .kind = Dither::jarvis, .stored = index_layout(1), .palette = default_palette_of(1), .light = {}};
  const std::uint32_t flag = working_layout(c.stored).index_flag();
  EXPECT_EQ(diffused(c, {0x737373, flag | 1, 0x757575}, 3), (Words{0, 1, 1}));
  EXPECT_EQ(diffused(c, {0, flag | 1, 0x757575}, 3), (Words{0, 1, 0}));
}

TEST(ErrorDiffusion, AlphaPassesThrough) {
  ColorLayout stored = rgb_layout(12);
  stored.alpha_bits = 8;
  Words words = picture(8, 8, 1);
  for (std::size_t i = 0; i < words.size(); ++i) words[i] |= static_cast<std::uint32_t>(3 * i) << 24;
  const Words result = diffused({.stored = stored, .palette = {}, .light = {}}, words, 8);
  for (std::size_t i = 0; i < words.size(); ++i) EXPECT_EQ(result[i] >> 12, 3 * i & 255);
}

TEST(ErrorDiffusion, WorksOnASinglePixelAndOnAColumn) {
  for (const Dither kind : {Dither::floyd_steinberg, Dither::jarvis}) {
    const Case c{.kind = kind, .stored = rgb_layout(3), .palette = {}, .light = {}};
    EXPECT_EQ(diffused(c, {0xff0000}, 1), Words{4});
    const Words column = diffused(c, Words(600, 0x808080), 1);
    const auto white = std::count(column.begin(), column.end(), 7u);
    EXPECT_NEAR(static_cast<double>(white) / 600, 128 / 255.0, 0.01);
  }
}

}  // namespace
}  // namespace tessera::detail::error_diffusion_test
