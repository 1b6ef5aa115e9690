// Geometry of panels: pixels, and their structure of subpixels or cells.
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "framebuffer/display/display_color.h"
#include "framebuffer/display/screen_layout.h"

namespace tessera::detail {
namespace {

constexpr double kMmPerInch = 25.4;
constexpr double kMinPixelsPerPeriod = 2;  ///< as for tubes

/// What of a panel's pixel emits light.
struct PixelStructure {
  bool has_stripes;  ///< three subpixels, each a third of the width
  bool reversed;     ///< blue is left
  double fill;       ///< share of the width and of the height of a subpixel that emits
};

double diagonal_in(const Display& display) {
  switch (display.kind) {
    case DisplayKind::plasma: return display.plasma.diagonal_in;
    case DisplayKind::eink: return display.eink.diagonal_in;
    default: return display.lcd.diagonal_in;
  }
}

PixelStructure structure_of(const Display& display) {
  switch (display.kind) {
    case DisplayKind::plasma: return {true, false, display.plasma.fill};
    case DisplayKind::eink: return {false, false, 1};
    default: return {true, display.lcd.stripes == SubpixelOrder::bgr, display.lcd.fill};
  }
}

ColorMatrix matrix_of(const Display& display) {
  if (display.kind == DisplayKind::plasma)
    return srgb_from_display(display.plasma.primaries, display.plasma.white);
  return srgb_from_display(display.lcd.primaries, display.lcd.white);
}

/// Light of white at a point between samples.
double white_at(const SpreadFunction& spread, double spacing_mm, double position_mm) {
  const int reach = static_cast<int>(spread.reach_mm / spacing_mm) + 2;
  double sum = 0;
  for (int k = -reach; k <= reach; ++k) {
    const double distance = position_mm - k * spacing_mm;
    if (std::abs(distance) <= spread.reach_mm) sum += spread.light(distance);
  }
  return sum;
}

}  // namespace

ScreenLayout panel_layout(const Display& display, const VideoMode& mode, const ScreenView& view) {
  ScreenLayout layout;
  const double aspect = mode.pixel_aspect * mode.width / mode.height;
  const double height = kMmPerInch * diagonal_in(display) / std::sqrt(1 + aspect * aspect);
  place_view(height * aspect, height, view, layout);
  layout.picture_width_mm = layout.screen_width_mm;
  layout.picture_height_mm = layout.screen_height_mm;
  if (display.kind == DisplayKind::eink) set_one_color({1, 1, 1}, layout);
  else set_colors(matrix_of(display), layout);

  const PixelStructure structure = structure_of(display);
  const double width_mm = layout.picture_width_mm / mode.width;
  const double height_mm = layout.picture_height_mm / mode.height;
  const double pixel_mm = layout.columns.pitch_mm;
  const bool detail = std::min(width_mm, height_mm) >= kMinPixelsPerPeriod * pixel_mm;
  const bool stripes = detail && structure.has_stripes;
  const double fill = detail ? structure.fill : 1;
  const SampleGrid along{mode.width, -layout.picture_width_mm / 2 + width_mm / 2, width_mm};
  const SampleGrid across{mode.height, -layout.picture_height_mm / 2 + height_mm / 2, height_mm};
  const SpreadFunction vertical = box_spread(0, fill * height_mm, height_mm, pixel_mm, detail);
  std::vector<SpreadFunction> horizontal;
  for (std::size_t color = 0; color < layout.colors; ++color) {
    const double place = (static_cast<double>(color) - 1) * (structure.reversed ? -1 : 1);
    const double offset = stripes ? place * width_mm / 3 : 0;
    const double width = fill * (stripes ? width_mm / 3 : width_mm);
    horizontal.push_back(box_spread(offset, width, width_mm, pixel_mm, detail));
    layout.planes.push_back({color, make_resample_table(along, layout.columns, horizontal.back()),
                             make_resample_table(across, layout.rows, vertical)});
  }

  constexpr int kPoints = 64;
  double brightest = 0;
  for (int k = 0; k < kPoints; ++k) {
    std::array<double, 3> light{};
    for (std::size_t color = 0; color < layout.colors; ++color)
      light[color] = white_at(horizontal[color], width_mm, k * width_mm / kPoints);
    brightest = std::max(brightest, brightest_component(layout, light));
  }
  layout.peak = brightest * white_at(vertical, height_mm, 0);
  if (structure.has_stripes && !detail)
    layout.notes.push_back("the image has " + number_text(width_mm / pixel_mm) + " x " +
                           number_text(height_mm / pixel_mm) +
                           " pixels per pixel of the panel, below 2: it shows the mean of the subpixels");
  return layout;
}

}  // namespace tessera::detail
