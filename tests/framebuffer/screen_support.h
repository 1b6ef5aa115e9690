// Pictures for displays, and what screens show of them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "framebuffer/tessera/screen.hpp"

namespace tessera::screen_support {

using Level = std::array<std::uint8_t, 3>;

/// RGB levels without gaps. level(x, y) is called for each pixel.
template <class Function>
std::vector<std::uint8_t> picture(int width, int height, const Function& level) {
  std::vector<std::uint8_t> levels;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const Level pixel = level(x, y);
      levels.insert(levels.end(), pixel.begin(), pixel.end());
    }
  return levels;
}

inline std::vector<std::uint8_t> field(int width, int height, Level level) {
  return picture(width, height, [&](int, int) { return level; });
}

inline std::vector<std::uint8_t> gray_field(int width, int height, int level) {
  const auto gray = static_cast<std::uint8_t>(level);
  return field(width, height, {gray, gray, gray});
}

/// Linear light of an image.
struct LightImage {
  int width, height;
  std::vector<float> light;

  double at(int x, int y, std::size_t component) const {
    return static_cast<double>(light[3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                                          static_cast<std::size_t>(x)) +
                                     component]);
  }
  double mean(std::size_t component) const {
    double sum = 0;
    for (std::size_t i = component; i < light.size(); i += 3) sum += static_cast<double>(light[i]);
    return sum / (static_cast<double>(width) * height);
  }
};

inline LightImage show(Screen& screen, const std::vector<std::uint8_t>& rgb, double time_ms) {
  LightImage image{screen.width(), screen.height(), {}};
  image.light.resize(3 * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
  screen.show({.rgb = rgb}, time_ms, {.light = image.light.data()});
  return image;
}

inline LightImage show_once(const std::string& display, const VideoMode& mode, const ScreenView& view,
                            const std::vector<std::uint8_t>& rgb) {
  Screen screen(find_display(display), mode, view);
  return show(screen, rgb, 0);
}

}  // namespace tessera::screen_support
