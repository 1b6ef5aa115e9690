// HSV, HSL, HSI and HVC.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "framebuffer/tessera/color.hpp"
#include "framebuffer/trigonometry.h"

namespace tessera {
namespace {

/// Greatest and least component.
struct Extremes {
  double max, min;
  double chroma() const { return max - min; }
};
Extremes extremes_of(const ColorValues& rgb) {
  const auto [min, max] = std::minmax({rgb[0], rgb[1], rgb[2]});
  return {max, min};
}

double ratio_or_zero(double numerator, double denominator) {
  return denominator == 0 ? 0 : numerator / denominator;
}

/// An angle in degrees as 0 up to but not including 360.
double wrapped(double degrees) {
  const double turn = std::fmod(degrees, 360.0);  // exact
  const double positive = turn < 0 ? turn + 360 : turn;
  return positive < 360 ? positive : 0;
}

double hexagonal_hue(const ColorValues& rgb, const Extremes& e) {
  const auto [r, g, b] = rgb;
  if (e.chroma() == 0) return 0;
  if (e.max == r) return wrapped(60 * ((g - b) / e.chroma()));
  if (e.max == g) return 60 * ((b - r) / e.chroma() + 2);
  return 60 * ((r - g) / e.chroma() + 4);
}

ColorValues rgb_from_hexagonal_hue(double hue, double chroma, double min) {
  const double sixth = wrapped(hue) / 60;
  // Around the hexagon each component rises, stays, stays, falls and is 0 twice.
  const auto component = [&](double offset) {
    const double position = std::fmod(sixth + offset, 6.0);
    return min + chroma * std::clamp(std::min(position, 4 - position), 0.0, 1.0);
  };
  return {component(2), component(0), component(4)};
}

}  // namespace

ColorValues hsv_from_rgb(const ColorValues& rgb) {
  const Extremes e = extremes_of(rgb);
  return {hexagonal_hue(rgb, e), ratio_or_zero(e.chroma(), e.max), e.max};
}
ColorValues rgb_from_hsv(const ColorValues& hsv) {
  const auto [hue, saturation, value] = hsv;
  const double chroma = saturation * value;
  return rgb_from_hexagonal_hue(hue, chroma, value - chroma);
}

ColorValues hsl_from_rgb(const ColorValues& rgb) {
  const Extremes e = extremes_of(rgb);
  const double lightness = (e.max + e.min) / 2;
  return {hexagonal_hue(rgb, e), ratio_or_zero(e.chroma(), 1 - std::abs(2 * lightness - 1)), lightness};
}
ColorValues rgb_from_hsl(const ColorValues& hsl) {
  const auto [hue, saturation, lightness] = hsl;
  const double chroma = saturation * (1 - std::abs(2 * lightness - 1));
  return rgb_from_hexagonal_hue(hue, chroma, lightness - chroma / 2);
}

ColorValues hsi_from_rgb(const ColorValues& rgb) {
  const auto [r, g, b] = rgb;
  const double hue = detail::direction_degrees(std::numbers::sqrt3 / 2 * (g - b), r - (g + b) / 2);
  const double intensity = (r + g + b) / 3;
  return {hue, ratio_or_zero(intensity - extremes_of(rgb).min, intensity), intensity};
}
ColorValues rgb_from_hsi(const ColorValues& hsi) {
  const auto [hue, saturation, intensity] = hsi;
  const auto [sine, cosine] = detail::sine_cosine(hue);
  // Differences to the intensity of a colour with circular chroma 1. The least of them, -2/3 to -1/3, belongs
  // to the component m = I (1 - S).
  const ColorValues difference = {2 * cosine / 3, sine / std::numbers::sqrt3 - cosine / 3,
                                  -sine / std::numbers::sqrt3 - cosine / 3};
  const double chroma = -intensity * saturation / extremes_of(difference).min;
  return {intensity + chroma * difference[0], intensity + chroma * difference[1],
          intensity + chroma * difference[2]};
}

ColorValues hvc_from_rgb(const ColorValues& rgb) {
  const Extremes e = extremes_of(rgb);
  return {hexagonal_hue(rgb, e), e.max, e.chroma()};
}
ColorValues rgb_from_hvc(const ColorValues& hvc) {
  const auto [hue, value, chroma] = hvc;
  return rgb_from_hexagonal_hue(hue, chroma, value - chroma);
}

}  // namespace tessera
