#include "framebuffer/display/picture_levels.h"

#include <array>
#include <cstddef>
#include <string>

namespace tessera::detail {
namespace {

constexpr std::size_t kMaxPlanes = 24;

std::size_t size_of(int n) { return static_cast<std::size_t>(n); }

/// Bytes from the first to the last row's end.
std::size_t needed_bytes(std::ptrdiff_t stride, std::size_t row_bytes, int height) {
  return static_cast<std::size_t>(stride) * (size_of(height) - 1) + row_bytes;
}

void require_bytes(const std::string& what, std::size_t found, std::ptrdiff_t stride, std::size_t row_bytes,
                   int height) {
  if (stride < static_cast<std::ptrdiff_t>(row_bytes))
    throw DisplayError(what + ": the stride is " + std::to_string(stride) + " bytes, a row has " +
                       std::to_string(row_bytes));
  if (const std::size_t expected = needed_bytes(stride, row_bytes, height); found < expected)
    throw DisplayError(what + " has " + std::to_string(found) + " bytes, the mode needs " +
                       std::to_string(expected));
}

std::uint8_t displayed_level(std::uint32_t value, int bits) {
  if (bits == 0) return 0;
  const std::uint32_t max = (1u << bits) - 1;
  return static_cast<std::uint8_t>((510 * (value & max) + max) / (2 * max));  // round(255 v / max)
}

using Level = std::array<std::uint8_t, 3>;

/// Levels of a pixel value without a palette: luminance, or red, green and blue from the highest bits down;
/// the first remaining bit goes to green, the second to red.
Level rgb_levels(std::uint32_t value, int bits) {
  if (bits <= 2) {
    const std::uint8_t gray = displayed_level(value, bits);
    return {gray, gray, gray};
  }
  const int blue = bits / 3, green = blue + (bits % 3 >= 1), red = blue + (bits % 3 == 2);
  return {displayed_level(value >> (blue + green), red), displayed_level(value >> blue, green),
          displayed_level(value, blue)};
}

Level palette_levels(std::span<const std::uint32_t> palette, std::uint32_t index) {
  if (index >= palette.size()) return {};
  const std::uint32_t color = palette[index];
  return {static_cast<std::uint8_t>(color >> 16), static_cast<std::uint8_t>(color >> 8),
          static_cast<std::uint8_t>(color)};
}

void read_planes(const VideoPicture& picture, int width, int height, std::vector<std::uint8_t>& levels) {
  const std::size_t row_bytes = (size_of(width) + 7) / 8;
  const std::ptrdiff_t stride =
      picture.plane_stride_bytes != 0 ? picture.plane_stride_bytes : static_cast<std::ptrdiff_t>(row_bytes);
  if (picture.planes.size() > kMaxPlanes)
    throw DisplayError("the picture has " + std::to_string(picture.planes.size()) +
                       " planes, expected 1 to 24");
  for (const auto& plane : picture.planes)
    require_bytes("a plane of the picture", plane.size(), stride, row_bytes, height);
  const int bits = static_cast<int>(picture.planes.size());
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      std::uint32_t value = 0;
      const std::size_t byte = size_of(y) * static_cast<std::size_t>(stride) + size_of(x / 8);
      for (int k = 0; k < bits; ++k) value |= (picture.planes[size_of(k)][byte] >> (7 - x % 8) & 1u) << k;
      const Level level =
          picture.palette.empty() ? rgb_levels(value, bits) : palette_levels(picture.palette, value);
      levels.insert(levels.end(), level.begin(), level.end());
    }
}

void read_rgb(const VideoPicture& picture, int width, int height, std::vector<std::uint8_t>& levels) {
  if (picture.pixel_bytes != 3 && picture.pixel_bytes != 4)
    throw DisplayError("pixel_bytes is " + std::to_string(picture.pixel_bytes) + ", expected 3 or 4");
  const std::size_t row_bytes = size_of(width) * size_of(picture.pixel_bytes);
  const std::ptrdiff_t stride =
      picture.stride_bytes != 0 ? picture.stride_bytes : static_cast<std::ptrdiff_t>(row_bytes);
  require_bytes("the picture", picture.rgb.size(), stride, row_bytes, height);
  for (int y = 0; y < height; ++y) {
    const std::uint8_t* pixel = picture.rgb.data() + size_of(y) * static_cast<std::size_t>(stride);
    if (picture.pixel_bytes == 3) {
      levels.insert(levels.end(), pixel, pixel + row_bytes);
      continue;
    }
    for (int x = 0; x < width; ++x, pixel += picture.pixel_bytes)
      levels.insert(levels.end(), pixel, pixel + 3);
  }
}

}  // namespace

std::vector<std::uint8_t> read_levels(const VideoPicture& picture, int width, int height) {
  if (picture.rgb.empty() == picture.planes.empty())
    throw DisplayError(picture.rgb.empty() ? "the picture is empty: neither rgb nor planes are set"
                                           : "the picture has both rgb and planes, expected one of them");
  std::vector<std::uint8_t> levels;
  levels.reserve(3 * size_of(width) * size_of(height));
  if (picture.planes.empty()) read_rgb(picture, width, height, levels);
  else read_planes(picture, width, height, levels);
  return levels;
}

}  // namespace tessera::detail
