// Comparison, clamping and packing of a single value or colour, for code without lanes.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "framebuffer/format.h"
#include "shading/fragment_ops.h"

namespace tessera::detail {

template <class Number>
constexpr bool compares(Number a, Compare op, Number b) {
  switch (op) {
    case Compare::never: return false;
    case Compare::less: return a < b;
    case Compare::equal: return a == b;
    case Compare::lequal: return a <= b;
    case Compare::greater: return a > b;
    case Compare::notequal: return a != b;
    case Compare::gequal: return a >= b;
    default: return true;
  }
}

using Rgba = std::array<float, 4>;

/// Clamps to 0..1. A NaN becomes 0.
inline float clamp_unit(float c) {
  if (!(c > 0.0f)) return 0.0f;
  return c < 1.0f ? c : 1.0f;
}

/// Packs a clamped colour: each component is floor(c (2^bits - 1) + t); with a dither in light after
/// ColorDither::component(). RGB and luminance layouts.
inline std::uint32_t pack_color(const ColorLayout& layout, const Rgba& c, float t,
                                const ColorDither* dither = nullptr) {
  const auto level = [&](float x, int bits) {
    return static_cast<std::uint32_t>(
        static_cast<std::int32_t>(std::fma(x, static_cast<float>((1 << bits) - 1), t)));
  };
  const auto component = [&](std::size_t k, float x) {
    return dither != nullptr ? dither->component(k, x) : x;
  };
  const std::uint32_t alpha = layout.alpha_bits == 0 ? 0 : level(c[3], layout.alpha_bits) << layout.bits;
  if (layout.luminance) {
    const float luminance = std::fma(kLumaR, c[0], std::fma(kLumaG, c[1], kLumaB * c[2]));
    return alpha | level(component(0, clamp_unit(luminance)), layout.bits);
  }
  const std::uint32_t red = level(component(0, c[0]), layout.r_bits) << layout.r_shift();
  const std::uint32_t green = level(component(1, c[1]), layout.g_bits) << layout.g_shift();
  return alpha | red | green | level(component(2, c[2]), layout.b_bits);
}

}  // namespace tessera::detail
