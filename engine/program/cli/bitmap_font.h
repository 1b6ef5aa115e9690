// A bitmap font of the printable ASCII characters, for labels in pictures.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "engine/program/imageio/picture.h"

namespace tessera::program::cli {

/// Pixels of a glyph. Capitals and digits use the upper 7 rows; the lowest row is for descenders.
inline constexpr int kGlyphWidth = 5, kGlyphHeight = 8;
/// From the left edge of a glyph to that of the next one.
inline constexpr int kGlyphAdvance = kGlyphWidth + 1;

/// Returns whether pixel (x, y) of a character is set; y counts from the top. Characters other than printable
/// ASCII look like '?'.
bool glyph_pixel(char character, int x, int y);

/// Width of a line in pixels, each pixel of a glyph drawn as scale x scale pixels; 0 for an empty line.
int text_width(std::string_view text, int scale);

struct TextStyle {
  int scale = 1;                        ///< at least 1
  std::array<std::uint8_t, 3> color{};  ///< red, green, blue
};

/// Draws a line of text whose first glyph has its upper left corner at (x, y). Pixels outside the picture are
/// left out.
void draw_text(std::string_view text, int x, int y, const TextStyle& style, Picture& picture);

}  // namespace tessera::program::cli
