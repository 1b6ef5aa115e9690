#include "engine/program/cli/close_up.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "framebuffer/srgb.h"

namespace tessera::program::cli {
namespace {

constexpr double kMaxClippedShare = 0.01;

double rounded(double value, double steps) { return std::floor(value * steps + 0.5) / steps; }

bool is_panel(DisplayKind kind) {
  return kind == DisplayKind::lcd || kind == DisplayKind::plasma || kind == DisplayKind::eink;
}

/// The raster has the shape of the mode within the screen, enlarged by the overscan.
double scan_line_mm(const CrtTube& tube, const VideoMode& mode, const ScreenSize& screen) {
  const double raster_width = screen.width_mm / (1 - tube.overscan);
  const double raster_height = screen.height_mm / (1 - tube.overscan);
  const double row_mm =
      std::min(raster_height / mode.height, raster_width / (mode.pixel_aspect * mode.width));
  const int mode_lines = mode.timing ? mode.timing->lines_per_row : 1;
  return row_mm / (tube.lines_per_row > 0 ? tube.lines_per_row : mode_lines);
}

/// Columns of dots of one colour, a hexagonal grid, are sqrt(3) / 2 of the pitch apart. The pitch of slots
/// and grilles is horizontal.
double triad_mm(const CrtTube& tube) {
  return tube.mask == ShadowMask::dots ? std::numbers::sqrt3 / 2 * tube.pitch_mm : tube.pitch_mm;
}

/// Places a part of a length around a point, within 0 .. `screen_mm`.
double part_begin(double share, double length_mm, double screen_mm) {
  return rounded(std::clamp(share * screen_mm - length_mm / 2, 0.0, screen_mm - length_mm), 1000);
}

/// Largest component of the brightest pixel but for the share that may be clipped, 1 to 255.
int brightest_level(const Picture& image) {
  std::array<std::size_t, 256> pixels{};
  for (std::size_t i = 0; i < image.rgba.size(); i += 4)
    ++pixels[std::max({image.rgba[i], image.rgba[i + 1], image.rgba[i + 2]})];
  const double allowed = kMaxClippedShare * static_cast<double>(image.rgba.size() / 4);
  std::size_t level = 255, brighter = pixels[255];
  while (level > 1 && static_cast<double>(brighter) <= allowed) brighter += pixels[--level];
  return static_cast<int>(level);
}

}  // namespace

double finest_period_mm(const Display& display, const VideoMode& mode, const ScreenSize& screen) {
  if (is_panel(display.kind)) return std::min(screen.width_mm / mode.width, screen.height_mm / mode.height);
  const double line_mm = scan_line_mm(display.crt, mode, screen);
  return display.crt.mask == ShadowMask::none ? line_mm : std::min(line_mm, triad_mm(display.crt));
}

ScreenView close_up_view(const Display& display, const VideoMode& mode, const ScreenSize& screen,
                         const ScreenPlace& place) {
  const double scale = rounded(kCloseUpPixelsPerPeriod / finest_period_mm(display, mode, screen), 100);
  const double width = rounded(std::min(kCloseUpWidth / scale, screen.width_mm), 1000);
  const double height = rounded(std::min(kCloseUpHeight / scale, screen.height_mm), 1000);
  return {.scale_px_per_mm = scale,
          .x_mm = part_begin(place.x, width, screen.width_mm),
          .y_mm = part_begin(place.y, height, screen.height_mm),
          .width_mm = width,
          .height_mm = height};
}

double exposure_gain(const Picture& image, double white_level) {
  const double brightest_light = detail::linear_from_srgb(brightest_level(image) / 255.0);
  return std::max(1.0, std::floor(std::min(1 / brightest_light, 1 / white_level) * 100) / 100);
}

}  // namespace tessera::program::cli
