// Colours as text: three numbers, or #RRGGBB.
#pragma once

#include <istream>
#include <string>
#include <string_view>
#include <vector>

#include "framebuffer/tessera/color.hpp"

namespace tessera::program::cli {

/// Reads colours from words. Spaces and commas separate numbers, also within a word.
/// - Numbers are decimal, from -1e6 to 1e6.
/// - A word #RRGGBB is a whole colour; spaces of R'G'B' only.
/// @throws Error for other words and for an incomplete colour
std::vector<ColorValues> parse_colors(const std::vector<std::string>& words, const NamedColorSpace& space);

/// Reads one colour per line. Empty lines are ignored.
/// @throws Error as parse_colors(), with the number of the line
std::vector<ColorValues> read_colors(std::istream& stream, const NamedColorSpace& space);

/// Three numbers with ten digits, separated by spaces.
std::string color_text(const ColorValues& values);

}  // namespace tessera::program::cli
