// The font of labels in pictures.
#include <gtest/gtest.h>

#include <set>
#include <string>

#include "engine/program/cli/bitmap_font.h"

namespace tessera::program::cli::bitmap_font_test {
namespace {

std::string bits_of(char character) {
  std::string bits;
  for (int y = 0; y < kGlyphHeight; ++y)
    for (int x = 0; x < kGlyphWidth; ++x) bits += glyph_pixel(character, x, y) ? '#' : '.';
  return bits;
}

int set_pixels(const Picture& picture) {
  int count = 0;
  for (std::size_t i = 0; i < picture.rgba.size(); i += 4) count += picture.rgba[i] == 9 ? 1 : 0;
  return count;
}

constexpr TextStyle kStyle{.scale = 1, .color = {9, 8, 7}};

TEST(BitmapFont, GlyphsDiffer) {
  std::set<std::string> glyphs;
  for (char c = ' '; c <= '~'; ++c) glyphs.insert(bits_of(c));
  EXPECT_EQ(glyphs.size(), 95u);
  EXPECT_EQ(bits_of(' ').find('#'), std::string::npos);
  EXPECT_EQ(bits_of('\t'), bits_of('?'));
  EXPECT_EQ(bits_of('\xe9'), bits_of('?'));
}

TEST(BitmapFont, OnlyDescendersReachTheLowestRow) {
  std::string descenders;
  for (char c = ' '; c <= '~'; ++c)
    if (bits_of(c).substr(kGlyphWidth * (kGlyphHeight - 1)).find('#') != std::string::npos) descenders += c;
  EXPECT_EQ(descenders, ",;_gjpqy");
}

TEST(BitmapFont, DrawsALetter) {
  EXPECT_EQ(bits_of('T'), "#####..#....#....#....#....#....#.......");
  EXPECT_EQ(bits_of('h'), "#....#....#.##.##..##...##...##...#.....");
}

TEST(BitmapFont, DrawsTextInItsWidth) {
  const std::string text = "vga13h 320x200, {8} bits";
  for (const int scale : {1, 2, 3}) {
    Picture picture(text_width(text, scale), kGlyphHeight * scale);
    draw_text(text, 0, 0, {.scale = scale, .color = kStyle.color}, picture);
    int expected = 0;
    for (const char c : text)
      for (const char bit : bits_of(c)) expected += bit == '#' ? scale * scale : 0;
    EXPECT_EQ(set_pixels(picture), expected) << scale;
    EXPECT_EQ(text_width(text, scale), (6 * 24 - 1) * scale);
  }
  EXPECT_EQ(text_width("", 2), 0);
}

TEST(BitmapFont, LeavesOutPixelsBesideThePicture) {
  Picture picture(10, 10);
  draw_text("W", -2, -3, kStyle, picture);
  draw_text("W", 8, 8, kStyle, picture);
  draw_text("W", 30, 4, kStyle, picture);
  EXPECT_GT(set_pixels(picture), 0);
  EXPECT_EQ(picture.rgba.size(), 400u);
}

}  // namespace
}  // namespace tessera::program::cli::bitmap_font_test
