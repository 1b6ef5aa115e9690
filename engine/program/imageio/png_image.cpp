#include "engine/program/imageio/png_image.h"

#include <cstring>

namespace tessera::program {
namespace {

/// Copies four bytes at a time: the fourth is overwritten by the next pixel.
void copy_rgb(const std::uint8_t* rgba, int width, std::uint8_t* row) {
  for (int x = 0; x + 1 < width; ++x) std::memcpy(row + 3 * x, rgba + 4 * x, 4);
  std::memcpy(row + 3 * (width - 1), rgba + 4 * (width - 1), 3);
}

/// Packs indices, the leftmost in the high bits. Bits to the right of the picture are 0.
void pack(const std::uint8_t* indices, int width, int bits, std::uint8_t* row) {
  const int per_byte = 8 / bits;
  for (int x = 0; x < width; x += per_byte) {
    unsigned byte = 0;
    for (int k = 0; k < per_byte; ++k) byte = byte << bits | (x + k < width ? indices[x + k] : 0u);
    row[x / per_byte] = static_cast<std::uint8_t>(byte);
  }
}

}  // namespace

int channel_count(PngColor color) {
  switch (color) {
    case PngColor::gray:
    case PngColor::palette: return 1;
    case PngColor::gray_alpha: return 2;
    case PngColor::rgb: return 3;
    case PngColor::rgba: return 4;
  }
  return 0;
}

std::size_t row_bytes(const PngFormat& format) {
  const std::size_t pixel_bits = static_cast<std::size_t>(channel_count(format.color) * format.bits);
  return (static_cast<std::size_t>(format.width) * pixel_bits + 7) / 8;
}

PngImage as_png(const Picture& picture, int channels) {
  const PngColor color = channels == 4 ? PngColor::rgba : PngColor::rgb;
  const auto fill_row = [&picture, channels](int y, std::uint8_t* row) {
    const std::size_t rgba_bytes = 4 * static_cast<std::size_t>(picture.width);
    const std::uint8_t* const rgba = picture.rgba.data() + static_cast<std::size_t>(y) * rgba_bytes;
    if (channels == 4) std::memcpy(row, rgba, rgba_bytes);
    else copy_rgb(rgba, picture.width, row);
  };
  return {.format = {.width = picture.width, .height = picture.height, .color = color},
          .palette = {},
          .fill_row = fill_row};
}

PngImage as_png(const IndexedPicture& picture) {
  const std::size_t entries = picture.palette.size() / 3;
  const std::size_t max_entries = std::size_t{1} << picture.bits;
  if (entries > max_entries)
    throw Error("the palette has " + std::to_string(entries) + " entries, must be at most " +
                std::to_string(max_entries) + " for " + std::to_string(picture.bits) + " bits");
  const auto fill_row = [&picture](int y, std::uint8_t* row) {
    const std::size_t first = static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width);
    pack(picture.indices.data() + first, picture.width, picture.bits, row);
  };
  return {.format = {.width = picture.width,
                     .height = picture.height,
                     .bits = picture.bits,
                     .color = entries > 0 ? PngColor::palette : PngColor::gray},
          .palette = picture.palette,
          .fill_row = fill_row};
}

}  // namespace tessera::program
