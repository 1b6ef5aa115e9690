#include "framebuffer/palette.h"

#include <gtest/gtest.h>

#include <limits>
#include <string_view>
#include <utility>
#include <vector>

namespace tessera::detail::palette_test {
namespace {

std::vector<Rgb8> entries(std::string_view name, int bits) { return palette_entries(name, bits).value(); }

TEST(PaletteEntries, UnsetAndOutOfRangeIndicesAreBlack) {
  const Palette palette{.bits = 3, .entries = entries("bw", 1)};
  EXPECT_EQ(palette.size(), 8u);
  EXPECT_EQ(palette[1], (Rgb8{255, 255, 255}));
  EXPECT_EQ(palette[2], Rgb8{});
  EXPECT_EQ(palette[7], Rgb8{});
  EXPECT_EQ(palette[0xffffffffu], Rgb8{});
}

TEST(PaletteEntries, QuantizeRoundsClampsAndTakesNanAsZero) {
  EXPECT_EQ(quantize_rgb8(0.5f, 1.0f, 0.0f), (Rgb8{128, 255, 0}));
  EXPECT_EQ(quantize_rgb8(-1.0f, 7.0f, std::numeric_limits<float>::quiet_NaN()), (Rgb8{0, 255, 0}));
}

TEST(PaletteEntries, UnknownNameYieldsNothing) {
  EXPECT_EQ(entries("bw", 1), (std::vector<Rgb8>{{0, 0, 0}, {255, 255, 255}}));
  EXPECT_EQ(entries("ega16", 4).size(), 16u);
  EXPECT_EQ(entries("vga256", 8).size(), 256u);
  EXPECT_EQ(entries("web216", 8).size(), 216u);
  EXPECT_FALSE(palette_entries("cga", 8).has_value());
  EXPECT_FALSE(palette_entries("", 8).has_value());
}

TEST(PaletteEntries, GreysAreEvenlySpacedAtEveryDepth) {
  EXPECT_EQ(entries("gray", 1), (std::vector<Rgb8>{{0, 0, 0}, {255, 255, 255}}));
  EXPECT_EQ(entries("gray", 2),
            (std::vector<Rgb8>{{0, 0, 0}, {85, 85, 85}, {170, 170, 170}, {255, 255, 255}}));
  for (int i = 0; i < 256; ++i) EXPECT_EQ(entries("gray", 8)[static_cast<std::size_t>(i)].g, i);
  EXPECT_EQ(entries("gray", 24).back(), (Rgb8{255, 255, 255}));
  EXPECT_EQ(entries("gray", 24)[1u << 23], (Rgb8{128, 128, 128}));
}

TEST(PaletteEntries, Ega16HasBrownAtIndex6) {
  const auto ega = entries("ega16", 4);
  EXPECT_EQ(ega[1], (Rgb8{0, 0, 170}));
  EXPECT_EQ(ega[4], (Rgb8{170, 0, 0}));
  EXPECT_EQ(ega[6], (Rgb8{170, 85, 0}));
  EXPECT_EQ(ega[8], (Rgb8{85, 85, 85}));
  EXPECT_EQ(ega[15], (Rgb8{255, 255, 255}));
}

TEST(PaletteEntries, Web216VariesBlueFastest) {
  const auto web = entries("web216", 8);
  for (int r = 0; r < 6; ++r)
    for (int g = 0; g < 6; ++g)
      for (int b = 0; b < 6; ++b) {
        const Rgb8 c = web[static_cast<std::size_t>(36 * r + 6 * g + b)];
        EXPECT_TRUE(c.r == 51 * r && c.g == 51 * g && c.b == 51 * b);
      }
}

// Colours of published listings of the power-on palette, 24 bits each.
TEST(PaletteEntries, Vga256IsTheDefaultPaletteOfMode13h) {
  const auto vga = entries("vga256", 8);
  const auto ega = entries("ega16", 4);
  for (std::size_t i = 0; i < 16; ++i) EXPECT_EQ(vga[i], ega[i]);
  EXPECT_EQ(vga[16], (Rgb8{0, 0, 0}));
  EXPECT_EQ(vga[17], (Rgb8{20, 20, 20}));
  EXPECT_EQ(vga[31], (Rgb8{255, 255, 255}));
  const std::pair<int, Rgb8> known[] = {
      {32, {0, 0, 255}},     {33, {65, 0, 255}},    {34, {125, 0, 255}},   {35, {190, 0, 255}},
      {36, {255, 0, 255}},   {37, {255, 0, 190}},   {40, {255, 0, 0}},     {41, {255, 65, 0}},
      {44, {255, 255, 0}},   {45, {190, 255, 0}},   {48, {0, 255, 0}},     {49, {0, 255, 65}},
      {52, {0, 255, 255}},   {53, {0, 190, 255}},   {55, {0, 65, 255}},    {56, {125, 125, 255}},
      {57, {158, 125, 255}}, {64, {255, 125, 125}}, {80, {182, 182, 255}}, {81, {198, 182, 255}},
      {104, {0, 0, 113}},    {105, {28, 0, 113}},   {128, {57, 57, 113}},  {152, {81, 81, 113}},
      {176, {0, 0, 65}},     {177, {16, 0, 65}},    {200, {32, 32, 65}},   {224, {45, 45, 65}},
      {247, {45, 49, 65}},
  };
  for (const auto& [i, color] : known) EXPECT_EQ(vga[static_cast<std::size_t>(i)], color) << i;
  for (std::size_t i = 248; i < 256; ++i) EXPECT_EQ(vga[i], Rgb8{});
}

TEST(PaletteEntries, DefaultDependsOnBits) {
  EXPECT_EQ(default_palette_name(1), "bw");
  for (int bits : {2, 3}) EXPECT_EQ(default_palette_name(bits), "gray");
  for (int bits : {4, 5, 6, 7}) EXPECT_EQ(default_palette_name(bits), "ega16");
  for (int bits = 8; bits <= 24; ++bits) EXPECT_EQ(default_palette_name(bits), "vga256");
  for (int bits = 1; bits <= 24; ++bits) {
    const Palette palette = default_palette_of(bits);
    EXPECT_EQ(palette.bits, bits);
    EXPECT_LE(palette.entries.size(), palette.size());
  }
  EXPECT_EQ(default_palette_of(3).entries.size(), 8u);
}

}  // namespace
}  // namespace tessera::detail::palette_test
