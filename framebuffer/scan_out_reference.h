// Scalar twin of the scan-out kernels: one pixel, by the definitions in format.h.
#pragma once

#include "framebuffer/format.h"
#include "framebuffer/palette.h"
#include "framebuffer/scan_out.h"

namespace tessera::detail {

/// The four bytes of a display pixel, the first byte lowest.
inline std::uint32_t scan_out_pixel_reference(const ColorLayout& layout, const Palette* palette,
                                              PixelOrder order, std::uint32_t packed) noexcept {
  std::uint32_t r, g, b;
  if (layout.index) {
    const Rgb8 entry = (*palette)[packed & layout.value_mask()];
    r = entry.r, g = entry.g, b = entry.b;
  } else if (layout.luminance) {
    r = g = b = display_level(packed & layout.value_mask(), layout.bits);
  } else {
    r = display_level((packed & layout.r_mask()) >> layout.r_shift(), layout.r_bits);
    g = display_level((packed & layout.g_mask()) >> layout.g_shift(), layout.g_bits);
    b = display_level(packed & layout.b_mask(), layout.b_bits);
  }
  const std::uint32_t a = layout.alpha_bits == 0 ? 255 : (packed & layout.alpha_mask()) >> layout.bits;
  return order == PixelOrder::rgba8 ? r | g << 8 | b << 16 | a << 24 : b | g << 8 | r << 16 | a << 24;
}

}  // namespace tessera::detail
