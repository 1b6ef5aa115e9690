// The transfer curve of sRGB, IEC 61966-2-1, with the same bits on every machine.
#pragma once

#include "framebuffer/exact_functions.h"

namespace tessera::detail {

/// Linear light of a stored value, 0 to 1: c / 12.92 up to 0.04045, else ((c + 0.055) / 1.055)^2.4.
inline double linear_from_srgb(double c) {
  if (c <= 0.04045) return c / 12.92;
  const double base = (c + 0.055) / 1.055;
  const double fifth_root = nth_root<5>(base);
  return base * base * (fifth_root * fifth_root);
}

/// Stored value of linear light, 0 to 1: 12.92 l up to 0.0031308, else 1.055 l^(1 / 2.4) - 0.055.
inline double srgb_from_linear(double l) {
  if (l <= 0.0031308) return 12.92 * l;
  const double cube_root = nth_root<3>(l);
  const double twelfth_root = nth_root<4>(cube_root);
  return 1.055 * (cube_root * twelfth_root) - 0.055;  // 1/3 + 1/12 = 1/2.4
}

}  // namespace tessera::detail
