#include "framebuffer/color_counts.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <map>
#include <random>
#include <vector>

namespace tessera::detail::color_counts_test {
namespace {

std::uint32_t packed(Rgb8 c) { return std::uint32_t{c.r} << 16 | std::uint32_t{c.g} << 8 | c.b; }

std::vector<std::uint32_t> random_words(std::size_t count, std::uint32_t mask, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<std::uint32_t> words(count);
  for (std::uint32_t& word : words) word = static_cast<std::uint32_t>(random()) & (0xff000000u | mask);
  return words;
}

TEST(PictureColorCounts, EqualThoseOfAMapOverSeveralPictures) {
  ColorCounts counts;
  EXPECT_TRUE(counts.empty());
  std::map<std::uint32_t, std::uint64_t> expected;
  for (unsigned seed = 0; seed < 3; ++seed) {
    const std::vector<std::uint32_t> words = random_words(20000, 0x1f3f0f, seed);
    counts.add(words);
    for (const std::uint32_t word : words) ++expected[word & 0xffffff];
  }
  std::map<std::uint32_t, std::uint64_t> found;
  for (const WeightedColor& c : counts.all()) EXPECT_TRUE(found.emplace(packed(c.color), c.pixels).second);
  EXPECT_EQ(found, expected);
  EXPECT_FALSE(counts.empty());
}

TEST(PictureColorCounts, CellsAreMeansOfColorsThatAgreeInTheirUpperBits) {
  const std::vector<std::uint32_t> words = random_words(60000, 0xffffff, 7);
  ColorCounts counts;
  counts.add(words);
  const std::vector<WeightedColor> cells = counts.at_most(5000);
  // 60,000 random colours fill all 4,096 cells of 4 bits, and nearly all 32,768 of 5 bits.
  ASSERT_EQ(cells.size(), 4096u);
  std::map<std::uint32_t, std::array<std::uint64_t, 4>> sums;
  for (const std::uint32_t word : words) {
    auto& sum = sums[word & 0xf0f0f0];
    sum[0] += word >> 16 & 255;
    sum[1] += word >> 8 & 255;
    sum[2] += word & 255;
    ++sum[3];
  }
  for (const WeightedColor& cell : cells) {
    const auto& sum = sums.at(packed(cell.color) & 0xf0f0f0);
    EXPECT_EQ(cell.pixels, sum[3]);
    const auto mean = [&](std::size_t i) {
      return static_cast<double>(sum[i]) / static_cast<double>(sum[3]);
    };
    EXPECT_NEAR(cell.color.r, mean(0), 0.5001);
    EXPECT_NEAR(cell.color.g, mean(1), 0.5001);
    EXPECT_NEAR(cell.color.b, mean(2), 0.5001);
  }
}

TEST(PictureColorCounts, FewColorsStayExact) {
  ColorCounts counts;
  counts.add(std::vector<std::uint32_t>{0x010203, 0xff010203, 0x010204});
  const std::vector<WeightedColor> colors = counts.at_most(8);
  ASSERT_EQ(colors.size(), 2u);
  EXPECT_EQ(colors[0].color, (Rgb8{1, 2, 3}));
  EXPECT_EQ(colors[0].pixels, 2u);
  EXPECT_EQ(colors[1].color, (Rgb8{1, 2, 4}));
}

}  // namespace
}  // namespace tessera::detail::color_counts_test
