#include "pixel_format.h"

#include <bit>
#include <cmath>

#include "lighting.h"

namespace tessera::reference {
namespace {

double max_level(int bits) { return static_cast<double>((std::uint64_t{1} << bits) - 1); }

std::uint32_t to_level(double c, int bits, double threshold = 0.5) {
  return static_cast<std::uint32_t>(std::floor(c * max_level(bits) + threshold));
}

std::uint8_t shown_level(std::uint32_t v, int bits) {
  return static_cast<std::uint8_t>(std::lround(255.0 * v / max_level(bits)));
}

bool is_luminance(const FrameBufferFormat& format) {
  return format.color_mode == ColorMode::kRgb && format.color_bits < 3;
}

std::uint32_t low_bits(int bits) { return (std::uint32_t{1} << bits) - 1; }

// A palette of N colours counts as a cube with cbrt(N) levels per side: the shift is at most half the
// distance between two levels.
Vec3 dithered_for_palette(Vec3 color, double threshold, std::size_t colors) {
  const double shift = (threshold - 0.5) / std::max(1.0, std::cbrt(static_cast<double>(colors)) - 1);
  return color + Vec3{shift, shift, shift};
}

}  // namespace

std::array<int, 3> split_bits(int color_bits) {
  const int odd = color_bits % 3;
  return {color_bits / 3 + (odd == 2 ? 1 : 0), color_bits / 3 + (odd >= 1 ? 1 : 0), color_bits / 3};
}

ColorFormat::ColorFormat(const FrameBufferFormat& format) : format_(format), nearest_(format.palette) {
  if (format.color_mode == ColorMode::kIndex || is_luminance(format)) {
    fields_ = {{0, format.color_bits}};
  } else {
    const auto [r, g, b] = split_bits(format.color_bits);
    fields_ = {{g + b, r}, {b, g}, {0, b}};
  }
  color_fields_ = fields_.size();
  if (format.alpha_bits > 0) fields_.push_back({format.color_bits, format.alpha_bits});
}

std::uint32_t ColorFormat::level(std::uint32_t word, Field field) const {
  return word >> field.lowest & low_bits(field.bits);
}

std::uint32_t ColorFormat::word(Vec4 color, double threshold) const {
  const Vec4 c = clamp01(color);
  if (format_.color_mode == ColorMode::kIndex)
    return nearest_(dithered_for_palette(xyz(c), threshold, format_.palette.size()));
  std::array<double, 4> components{c.x, c.y, c.z, c.w};
  if (is_luminance(format_)) components = {0.30 * c.x + 0.59 * c.y + 0.11 * c.z, c.w};
  std::uint32_t word = 0;
  for (std::size_t i = 0; i < fields_.size(); ++i)
    word |= to_level(components[i], fields_[i].bits, threshold) << fields_[i].lowest;
  return word;
}

std::uint32_t ColorFormat::index_word(double index) const {
  return static_cast<std::uint32_t>(masked_index(std::floor(index + 0.5), format_.color_bits));
}

Vec4 ColorFormat::color(std::uint32_t word) const {
  const auto component = [&](std::size_t i) { return level(word, fields_[i]) / max_level(fields_[i].bits); };
  const double alpha = fields_.size() > color_fields_ ? component(color_fields_) : 1;
  if (is_luminance(format_)) return {component(0), component(0), component(0), alpha};
  return {component(0), component(1), component(2), alpha};
}

std::uint32_t ColorFormat::mean(std::span<const std::uint32_t> words) const {
  std::uint32_t result = 0;
  for (const Field field : fields_) {
    std::uint32_t sum = 0;
    for (const std::uint32_t word : words) sum += level(word, field);
    const auto samples = static_cast<std::uint32_t>(words.size());
    result |= (2 * sum + samples) / (2 * samples) << field.lowest;  // floor(sum / samples + 0.5)
  }
  return result;
}

Rgb8 ColorFormat::shown(std::uint32_t word) const {
  if (format_.color_mode == ColorMode::kIndex)
    return word < format_.palette.size() ? format_.palette[word] : Rgb8{0, 0, 0};
  const auto component = [&](std::size_t i) { return shown_level(level(word, fields_[i]), fields_[i].bits); };
  if (is_luminance(format_)) return {component(0), component(0), component(0)};
  return {component(0), component(1), component(2)};
}

std::uint32_t ColorFormat::writable_planes(const std::array<bool, 4>& color_mask,
                                           std::uint32_t plane_mask) const {
  std::uint32_t planes = 0;
  for (std::size_t i = 0; i < fields_.size(); ++i)
    if (color_mask[i < color_fields_ ? i : 3]) planes |= low_bits(fields_[i].bits) << fields_[i].lowest;
  return planes & plane_mask;
}

double masked_index(double index, int bits) {
  const double count = std::ldexp(1.0, bits);
  return index - count * std::floor(index / count);
}

std::uint32_t depth_level(DepthFormat format, double depth) {
  switch (format) {
    case DepthFormat::kNone: return 0;
    case DepthFormat::kUnorm16: return to_level(depth, 16);
    case DepthFormat::kUnorm24: return to_level(depth, 24);
    case DepthFormat::kUnorm32: return to_level(depth, 32);
    case DepthFormat::kFloat32:
      return std::bit_cast<std::uint32_t>(static_cast<float>(depth) + 0.0f);  // never -0
  }
  return 0;
}

}  // namespace tessera::reference
