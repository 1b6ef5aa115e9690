#include "framebuffer/converter_colors.h"

#include <algorithm>

#include "framebuffer/check.h"
#include "framebuffer/format.h"
#include "framebuffer/srgb.h"

namespace tessera::detail {

ConverterColors::ConverterColors(int bits) noexcept : bits_(bits), max_level_((1 << bits) - 1) {
  TESSERA_ASSERT(bits >= 1 && bits <= 8);
}

std::size_t ConverterColors::position(const ConverterLevels& levels) const noexcept {
  std::size_t position = 0;
  for (const int level : levels) position = position << bits_ | static_cast<std::size_t>(level);
  return position;
}

Rgb8 ConverterColors::shown(const ConverterLevels& levels) const noexcept {
  const auto component = [this](int v) {
    return static_cast<std::uint8_t>(display_level(static_cast<std::uint32_t>(v), bits_));
  };
  return {component(levels[0]), component(levels[1]), component(levels[2])};
}

ConverterLevels ConverterColors::levels_of(Rgb8 color) const noexcept {
  const auto level = [this](int c) { return (2 * c * max_level_ + 255) / (2 * 255); };
  return {level(color.r), level(color.g), level(color.b)};
}

ConverterLevels ConverterColors::nearest(const Oklab& target) const noexcept {
  // Start: the nearest level of each component.
  const LinearRgb linear = linear_from_oklab(target);
  const auto level_of = [this](double light) {
    return static_cast<int>(srgb_from_linear(std::clamp(light, 0.0, 1.0)) * max_level_ + 0.5);
  };
  ConverterLevels levels{level_of(linear.r), level_of(linear.g), level_of(linear.b)};
  for (;;) {
    const ConverterLevels next = step(levels, target, 3, [](const ConverterLevels&) { return true; });
    if (next == levels) return levels;
    levels = next;
  }
}

ConverterLevels ConverterColors::step(const ConverterLevels& from, const Oklab& target, int max_components,
                                      const std::function<bool(const ConverterLevels&)>& allowed) const {
  ConverterLevels best = from;
  double best_distance = squared_distance(oklab_from_rgb8(shown(from)), target);
  const auto try_step = [&](int r, int g, int b) {
    const ConverterLevels levels{from[0] + r, from[1] + g, from[2] + b};
    for (const int level : levels)
      if (level < 0 || level > max_level_) return;
    const double distance = squared_distance(oklab_from_rgb8(shown(levels)), target);
    if (distance < best_distance && allowed(levels)) {
      best_distance = distance;
      best = levels;
    }
  };
  for (int r = -1; r <= 1; ++r)
    for (int g = -1; g <= 1; ++g)
      for (int b = -1; b <= 1; ++b)
        if (r * r + g * g + b * b <= max_components) try_step(r, g, b);
  return best;
}

}  // namespace tessera::detail
