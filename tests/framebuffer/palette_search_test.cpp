#include "framebuffer/palette_search.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "framebuffer/palette_search_reference.h"

namespace tessera::detail::palette_search_test {
namespace {

Palette random_palette(int bits, std::size_t given, std::uint32_t seed, int levels = 256) {
  std::mt19937 random(seed);
  Palette palette{.bits = bits, .entries = {}};
  const auto count = static_cast<unsigned>(levels);
  const auto level = [&] { return static_cast<std::uint8_t>(random() % count * 255 / (count - 1)); };
  for (std::size_t i = 0; i < given; ++i) palette.entries.push_back({level(), level(), level()});
  return palette;
}

std::vector<Palette> palettes() {
  std::vector<Palette> all;
  for (int bits = 1; bits <= 8; ++bits) all.push_back(default_palette_of(bits));
  for (const char* name : {"bw", "gray", "ega16", "vga256", "web216"})
    all.push_back({.bits = 8, .entries = *palette_entries(name, 8)});
  all.push_back({.bits = 1, .entries = {}});                                 // all black
  all.push_back({.bits = 4, .entries = {{255, 0, 0}, {255, 0, 0}}});         // equal entries, then unset ones
  all.push_back({.bits = 2, .entries = {{9, 9, 9}, {0, 0, 0}, {3, 3, 3}}});  // black before an unset entry
  all.push_back(random_palette(8, 256, 1));
  all.push_back(random_palette(8, 256, 2, 3));  // few levels: many ties
  all.push_back(random_palette(10, 777, 3));
  all.push_back(random_palette(12, 4096, 4));
  return all;
}

/// Critical components: levels, midpoints between levels, cell borders and their neighbouring floats, and
/// random values.
float component(std::mt19937& random) {
  const auto pick = random();
  const float c = static_cast<float>(random() % 511) / 510.0f;
  switch (pick % 8) {
    case 0: return c;
    case 1: return static_cast<float>(random() % 256) / 255.0f;
    case 2: return static_cast<float>(random() % 65) / 64.0f;
    case 3: return std::nextafter(static_cast<float>(random() % 65) / 64.0f, 0.0f);
    case 4: return std::nextafter(c, 1.0f);
    default: return static_cast<float>(random()) / 4294967296.0f;
  }
}

TEST(PaletteSearch, MatchesExhaustiveSearch) {
  for (const Palette& palette : palettes()) {
    const PaletteSearch search(palette);
    std::mt19937 random(5);
    const int trials = palette.size() > 1024 ? 5000 : 50000;
    for (int i = 0; i < trials; ++i) {
      const float r = component(random), g = component(random), b = component(random);
      ASSERT_EQ(search.nearest(r, g, b), nearest_reference(palette, r, g, b))
          << palette.bits << " bits, " << palette.entries.size() << " given: " << r << " " << g << " " << b;
    }
  }
}

// A dithered colour may lie outside the cube by up to half its width. Its nearest entry can differ from that
// of the clamped colour.
TEST(PaletteSearch, UnclampedMatchesExhaustiveSearchOutsideTheCube) {
  std::size_t differing = 0;
  for (const Palette& palette : palettes()) {
    if (palette.entries.empty() || palette.entries.size() > 300) continue;
    const PaletteSearch search(palette, 0.5f);
    std::mt19937 random(6);
    for (int i = 0; i < 5000; ++i) {
      const float color[3] = {2 * component(random) - 0.5f, 2 * component(random) - 0.5f,
                              2 * component(random) - 0.5f};
      std::uint32_t expected = 0;
      float min_distance = 100;
      for (std::uint32_t e = 0; e < palette.entries.size(); ++e) {
        const float dr = color[0] - static_cast<float>(palette[e].r) / 255.0f;
        const float dg = color[1] - static_cast<float>(palette[e].g) / 255.0f;
        const float db = color[2] - static_cast<float>(palette[e].b) / 255.0f;
        const float distance = dr * dr + dg * dg + db * db;
        if (distance < min_distance) min_distance = distance, expected = e;
      }
      const std::uint32_t found = search.nearest_unclamped(color[0], color[1], color[2]);
      ASSERT_EQ(found, expected) << palette.entries.size() << " given: " << color[0] << " " << color[1] << " "
                                 << color[2];
      differing += found != search.nearest(color[0], color[1], color[2]);
    }
  }
  EXPECT_GT(differing, 1000u);
}

// Lines through the cube on which ties are frequent.
TEST(PaletteSearch, MatchesExhaustiveSearchOnDiagonals) {
  for (const Palette& palette : palettes()) {
    const PaletteSearch search(palette);
    for (int i = -10; i <= 1030; ++i) {
      const float c = static_cast<float>(i) / 1020.0f;
      ASSERT_EQ(search.nearest(c, c, c), nearest_reference(palette, c, c, c)) << palette.bits << " " << c;
      ASSERT_EQ(search.nearest(c, 1 - c, 0.5f), nearest_reference(palette, c, 1 - c, 0.5f))
          << palette.bits << " " << c;
    }
  }
}

TEST(PaletteSearch, ClampsComponentsAndTakesNanAsZero) {
  const float inf = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
  const Palette palette = default_palette_of(4);
  const PaletteSearch search(palette);
  EXPECT_EQ(search.nearest(nan, nan, nan), 0u);
  EXPECT_EQ(search.nearest(inf, inf, inf), 15u);
  EXPECT_EQ(search.nearest(-inf, -3.0f, 1e30f), search.nearest(0, 0, 1));
  EXPECT_EQ(search.nearest(nan, 1.0f, -0.0f), search.nearest(0, 1, 0));
}

TEST(PaletteSearch, PrefersLowestIndexAndIgnoresUnsetEntries) {
  const PaletteSearch red({.bits = 2, .entries = {{255, 0, 0}, {255, 0, 0}}});
  EXPECT_EQ(red.nearest(1, 0, 0), 0u);
  EXPECT_EQ(red.nearest(0, 0, 0), 0u);  // unset entries are never chosen
  const PaletteSearch full({.bits = 1, .entries = {{255, 0, 0}, {0, 255, 0}}});
  EXPECT_EQ(full.nearest(0, 0, 0), 0u);  // all entries are set; a tie
}

TEST(PaletteSearch, FindsTheColourOfEveryEntry) {
  for (const Palette& palette : palettes()) {
    const PaletteSearch search(palette);
    for (std::uint32_t i = 0; i < palette.entries.size(); ++i) {
      const Rgb8 c = palette[i];
      const std::uint32_t found =
          search.nearest(static_cast<float>(c.r) / 255.0f, static_cast<float>(c.g) / 255.0f,
                         static_cast<float>(c.b) / 255.0f);
      ASSERT_EQ(palette[found], c);
      ASSERT_LE(found, i);
    }
  }
}

TEST(PaletteSearch, MatchesExhaustiveSearchFor65536Entries) {
  const Palette palette = random_palette(16, 65536, 6);
  const PaletteSearch search(palette);
  std::mt19937 random(8);
  for (int i = 0; i < 300; ++i) {
    const float r = component(random), g = component(random), b = component(random);
    ASSERT_EQ(search.nearest(r, g, b), nearest_reference(palette, r, g, b)) << r << " " << g << " " << b;
  }
}

}  // namespace
}  // namespace tessera::detail::palette_search_test
