// Colour and depth formats, with the one quantizer of each.
//
// Tiles keep a pixel's colour as the packed value that the planes store: R:G:B with blue lowest, or the
// palette index, so plane k is bit k; alpha planes follow above. Tiles keep depth as a signed key that orders
// as depth does: see depth_key_from_stored().
#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>

#include "framebuffer/tessera/enums.hpp"

namespace tessera::detail {

/// Fields of a packed colour. RGB of b bits: luminance at 1 and 2 bits, else b / 3 bits per component; the
/// first remaining bit goes to green, the second to red.
struct ColorLayout {
  int bits = 24;           ///< colour bits, without alpha
  bool index = false;      ///< the packed colour is a palette index
  bool luminance = false;  ///< the packed colour is one grey component of `bits` bits
  int r_bits = 8, g_bits = 8, b_bits = 8;
  int alpha_bits = 0;  ///< 0 or 8
  /// Bits of an index that a draw may store: all of an index layout's; 0 for RGB. RGB and index bits above 0:
  /// a pixel holds R:G:B, or index_flag() and an index.
  int index_bits = 0;
  int r_shift() const { return g_bits + b_bits; }
  int g_shift() const { return b_bits; }
  /// Colour bits, without alpha.
  std::uint32_t value_mask() const { return (std::uint32_t{1} << bits) - 1; }
  bool takes_indices() const { return index_bits > 0; }
  std::uint32_t index_mask() const { return (std::uint32_t{1} << index_bits) - 1; }
  float index_modulus() const { return static_cast<float>(std::uint32_t{1} << index_bits); }
  /// Marks an index in place of R:G:B; 0 if all pixels, or none, are indices.
  std::uint32_t index_flag() const { return !index && index_bits > 0 ? std::uint32_t{1} << bits : 0; }
  int planes() const { return bits + alpha_bits + (index_flag() != 0 ? 1 : 0); }
  std::uint32_t alpha_mask() const { return ((std::uint32_t{1} << alpha_bits) - 1) << bits; }
  std::uint32_t r_mask() const { return ((std::uint32_t{1} << r_bits) - 1) << r_shift(); }
  std::uint32_t g_mask() const { return ((std::uint32_t{1} << g_bits) - 1) << g_shift(); }
  std::uint32_t b_mask() const { return (std::uint32_t{1} << b_bits) - 1; }
};

constexpr ColorLayout rgb_layout(int bits) {
  ColorLayout layout{.bits = bits, .luminance = bits <= 2};
  layout.r_bits = bits / 3 + (bits % 3 == 2 ? 1 : 0);
  layout.g_bits = bits / 3 + (bits % 3 >= 1 ? 1 : 0);
  layout.b_bits = bits / 3;
  return layout;
}
constexpr ColorLayout index_layout(int bits) { return {.bits = bits, .index = true, .index_bits = bits}; }
/// Layout of the pixels of a frame whose colours are reduced to `stored` when it is finished: 8 bits per
/// component, or an index with a mark.
constexpr ColorLayout working_layout(const ColorLayout& stored) {
  ColorLayout layout = rgb_layout(24);
  layout.alpha_bits = stored.alpha_bits;
  layout.index_bits = stored.index_bits;
  return layout;
}

// Weights of luminance (1- and 2-bit buffers).
inline constexpr float kLumaR = 0.30f, kLumaG = 0.59f, kLumaB = 0.11f;

/// floor(c (2^b - 1) + 0.5), c clamped to 0..1; NaN counts as 0.
inline std::uint32_t quantize(float c, int bits) {
  const float levels = static_cast<float>((1u << bits) - 1);
  const float at_least_zero = c > 0.0f ? c : 0.0f;
  const float clamped = at_least_zero < 1.0f ? at_least_zero : 1.0f;
  return static_cast<std::uint32_t>(std::fma(clamped, levels, 0.5f));
}
/// Packed colour of an RGB or luminance layout.
inline std::uint32_t quantize_rgb(const ColorLayout& layout, float r, float g, float b) {
  if (layout.luminance) return quantize(std::fma(kLumaR, r, std::fma(kLumaG, g, kLumaB * b)), layout.bits);
  return quantize(r, layout.r_bits) << layout.r_shift() | quantize(g, layout.g_bits) << layout.g_shift() |
         quantize(b, layout.b_bits);
}
/// Fractional index modulo 2^bits: 0 .. modulus; NaN counts as 0.
inline float masked_index(float index, float modulus) {
  // Products with powers of two are exact.
  const float rest = index - modulus * std::floor(index * (1 / modulus));
  return rest >= 0 ? rest : 0.0f;
}
/// Packed colour of a masked index: floor(index + 0.5) modulo 2^bits. The fraction is compared with 0.5
/// because index + 0.5 is not exact above 2^23.
inline std::uint32_t quantize_index(const ColorLayout& layout, float index) {
  const auto whole = static_cast<std::uint32_t>(index > 0 ? index : 0.0f);
  const std::uint32_t nearest = whole + (index - static_cast<float>(whole) >= 0.5f ? 1 : 0);
  return (nearest & layout.index_mask()) | layout.index_flag();
}
/// 8-bit display level of level v of b bits: round(255 v / (2^b - 1)) in integers, 0 for b = 0.
/// @pre bits <= 16, so that the numerator fits in 32 bits
constexpr std::uint32_t display_level(std::uint32_t v, int bits) {
  const std::uint32_t max_level = (1u << bits) - 1;
  return max_level == 0 ? 0 : (2 * 255 * v + max_level) / (2 * max_level);
}

constexpr int depth_bits(DepthFormat kind) {
  switch (kind) {
    case DepthFormat::none: return 0;
    case DepthFormat::unorm16: return 16;
    case DepthFormat::unorm24: return 24;
    default: return 32;
  }
}

// Depth keys compare as signed integers in every format. unorm16, unorm24: the stored level; unorm32: the
// level with its top bit flipped; float32: the bits of the float, which is never negative.
constexpr std::int32_t depth_key_from_stored(DepthFormat kind, std::uint32_t word) {
  return static_cast<std::int32_t>(kind == DepthFormat::unorm32 ? word ^ 0x80000000u : word);
}
constexpr std::uint32_t stored_depth_from_key(DepthFormat kind, std::int32_t key) {
  return kind == DepthFormat::unorm32 ? static_cast<std::uint32_t>(key) ^ 0x80000000u
                                      : static_cast<std::uint32_t>(key);
}
/// Stored level floor(z (2^b - 1) + 0.5) for z in 0..1; the bits of the float for float32.
inline std::uint32_t quantize_depth(DepthFormat kind, double z) {
  if (kind == DepthFormat::float32) {
    const float f = static_cast<float>(z) + 0.0f;  // + 0: no negative zero
    std::uint32_t word;
    std::memcpy(&word, &f, sizeof word);
    return word;
  }
  const double levels = std::ldexp(1.0, depth_bits(kind)) - 1;
  return static_cast<std::uint32_t>(std::floor(z * levels + 0.5));
}
inline double dequantize_depth(DepthFormat kind, std::uint32_t word) {
  if (kind == DepthFormat::float32) {
    float f;
    std::memcpy(&f, &word, sizeof f);
    return f;
  }
  return word / (std::ldexp(1.0, depth_bits(kind)) - 1);
}

}  // namespace tessera::detail
