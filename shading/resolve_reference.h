// Scalar twin of resolve-inl.h and its specification: one pixel.
#pragma once

#include "framebuffer/format.h"

namespace tessera::detail {

/// The mean of the samples' levels: each component is rounded to the nearest level, halves up.
/// @param samples  4 or 8
inline std::uint32_t resolve_reference(const ColorLayout& layout, const std::uint32_t* packed, int samples) {
  const auto mean = [&](int shift, int bits) {
    std::uint32_t sum = static_cast<std::uint32_t>(samples) / 2;
    for (int s = 0; s < samples; ++s) sum += packed[s] >> shift & ((1u << bits) - 1);
    return sum / static_cast<std::uint32_t>(samples) << shift;
  };
  const std::uint32_t alpha = layout.alpha_bits == 0 ? 0 : mean(layout.bits, layout.alpha_bits);
  if (layout.luminance) return alpha | mean(0, layout.bits);
  return alpha | mean(layout.r_shift(), layout.r_bits) | mean(layout.g_shift(), layout.g_bits) |
         mean(0, layout.b_bits);
}

}  // namespace tessera::detail
