// Scalar twin of PaletteSearch: compares every set entry.
#pragma once

#include "framebuffer/palette.h"

namespace tessera::detail {

/// Specification of PaletteSearch::nearest().
inline std::uint32_t nearest_reference(const Palette& palette, float r, float g, float b) noexcept {
  const auto clamp = [](float c) {
    const float at_least_zero = c > 0.0f ? c : 0.0f;
    return at_least_zero < 1.0f ? at_least_zero : 1.0f;
  };
  const auto square = [](float d) { return d * d; };
  std::uint32_t nearest = 0;
  float nearest_distance = 4.0f;  // exceeds the squared diagonal of the cube, 3
  for (std::uint32_t i = 0; i < palette.entries.size(); ++i) {
    const Rgb8 stored = palette[i];
    const float distance = square(clamp(r) - static_cast<float>(stored.r) / 255.0f) +
                           square(clamp(g) - static_cast<float>(stored.g) / 255.0f) +
                           square(clamp(b) - static_cast<float>(stored.b) / 255.0f);
    if (distance < nearest_distance) {
      nearest_distance = distance;
      nearest = i;
    }
  }
  return nearest;
}

}  // namespace tessera::detail
