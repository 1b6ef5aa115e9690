// Pictures in the layout of PNG files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "engine/program/imageio/picture.h"

namespace tessera::program {

/// Colour types, with their numbers in files [PNG, 11.2.1].
enum class PngColor : std::uint8_t { gray = 0, rgb = 2, palette = 3, gray_alpha = 4, rgba = 6 };

/// Values of a file's header.
struct PngFormat {
  int width = 1, height = 1;
  int bits = 8;  ///< per component: 1, 2, 4 (gray and palette), 8, 16 (all but palette)
  PngColor color = PngColor::rgb;

  bool operator==(const PngFormat&) const = default;
};

/// A picture whose rows are made when the file is.
struct PngImage {
  PngFormat format;
  std::vector<std::uint8_t> palette;  ///< r g b per entry; empty unless the pixels are indices
  /// Fills row y from the top, row_bytes(format) long: components in the order of their names, 16 bits with
  /// the high byte first, smaller ones packed with the leftmost pixel in the high bits.
  std::function<void(int y, std::uint8_t* row)> fill_row;
};

int channel_count(PngColor color);
std::size_t row_bytes(const PngFormat& format);

/// @param channels  3: without alpha; 4
/// @param picture   must outlive the result
PngImage as_png(const Picture& picture, int channels);
/// @param picture  must outlive the result
/// @throws Error if the palette has more than 2^bits entries
PngImage as_png(const IndexedPicture& picture);

}  // namespace tessera::program
