#include "pixel_format.h"

#include <bit>

#include "lighting.h"

namespace tessera::reference {
namespace {

double max_level(int bits) { return static_cast<double>((std::uint64_t{1} << bits) - 1); }

std::uint32_t level(double c, int bits) { return static_cast<std::uint32_t>(std::floor(c * max_level(bits) + 0.5)); }

std::uint8_t shown_level(std::uint32_t v, int bits) {
  return static_cast<std::uint8_t>(std::lround(255.0 * v / max_level(bits)));
}

bool is_luminance(const FrameBufferFormat& format) { return format.color_mode == ColorMode::kRgb && format.color_bits < 3; }

std::uint32_t low_bits(int bits) { return (std::uint32_t{1} << bits) - 1; }

}  // namespace

std::array<int, 3> split_bits(int color_bits) {
  const int odd = color_bits % 3;
  return {color_bits / 3 + (odd == 2 ? 1 : 0), color_bits / 3 + (odd >= 1 ? 1 : 0), color_bits / 3};
}

ColorFormat::ColorFormat(const FrameBufferFormat& format) : format_(format), nearest_(format.palette) {}

std::uint32_t ColorFormat::word(Vec4 color) const {
  const Vec4 c = clamp01(color);
  if (format_.color_mode == ColorMode::kIndex) return nearest_(xyz(c));
  if (is_luminance(format_)) return level(0.30 * c.x + 0.59 * c.y + 0.11 * c.z, format_.color_bits);
  const auto [r, g, b] = split_bits(format_.color_bits);
  return level(c.x, r) << (g + b) | level(c.y, g) << b | level(c.z, b);
}

Rgb8 ColorFormat::shown(std::uint32_t word) const {
  if (format_.color_mode == ColorMode::kIndex) return word < format_.palette.size() ? format_.palette[word] : Rgb8{0, 0, 0};
  if (is_luminance(format_)) {
    const std::uint8_t grey = shown_level(word, format_.color_bits);
    return {grey, grey, grey};
  }
  const auto [r, g, b] = split_bits(format_.color_bits);
  return {shown_level(word >> (g + b), r), shown_level(word >> b & low_bits(g), g), shown_level(word & low_bits(b), b)};
}

std::uint32_t ColorFormat::writable_planes(const std::array<bool, 4>& color_mask, std::uint32_t plane_mask) const {
  const std::uint32_t all = low_bits(format_.color_bits);
  if (format_.color_mode == ColorMode::kIndex || is_luminance(format_)) return color_mask[0] ? all & plane_mask : 0;
  const auto [r, g, b] = split_bits(format_.color_bits);
  const std::uint32_t planes =
      (color_mask[0] ? low_bits(r) << (g + b) : 0) | (color_mask[1] ? low_bits(g) << b : 0) | (color_mask[2] ? low_bits(b) : 0);
  return planes & plane_mask;
}

std::uint32_t depth_level(DepthFormat format, double depth) {
  switch (format) {
    case DepthFormat::kNone: return 0;
    case DepthFormat::kUnorm16: return level(depth, 16);
    case DepthFormat::kUnorm24: return level(depth, 24);
    case DepthFormat::kUnorm32: return level(depth, 32);
    case DepthFormat::kFloat32: return std::bit_cast<std::uint32_t>(static_cast<float>(depth) + 0.0f);  // never -0
  }
  return 0;
}

}  // namespace tessera::reference
