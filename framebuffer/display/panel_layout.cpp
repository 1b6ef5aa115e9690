// Geometry of panels: pixels, and their structure of subpixels or cells.
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "framebuffer/display/display_color.h"
#include "framebuffer/display/screen_layout.h"
#include "framebuffer/display/stripe_series.h"

namespace tessera::detail {
namespace {

constexpr double kMmPerInch = 25.4;
constexpr double kMinPixelsPerPeriod = 2;  ///< as for tubes

/// Parts of a panel's pixel that emit light.
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

/// Subpixels of the panel: stripes across, and along the part of a row that emits.
PatternTables subpixels(const PixelStructure& structure, double width_mm, double height_mm,
                        const PixelGrid& columns, const PixelGrid& rows, double pixel_mm) {
  PatternTables tables;
  for (std::size_t color = 0; color < 3; ++color) {
    const double place = (static_cast<double>(color) - 1) * (structure.reversed ? -1 : 1);
    const Stripes stripes{width_mm, structure.fill * width_mm / 3, (place / 3 + 0.5) * width_mm};
    tables.column_factors[color].push_back(stripe_series(stripes, columns, pixel_mm));
  }
  const Stripes across{height_mm, structure.fill * height_mm, height_mm / 2};
  tables.row_factors.push_back(stripe_series(across, rows, pixel_mm));
  return tables;
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
  const SampleGrid along{mode.width, -layout.picture_width_mm / 2 + width_mm / 2, width_mm};
  const SampleGrid across{mode.height, -layout.picture_height_mm / 2 + height_mm / 2, height_mm};
  for (std::size_t color = 0; color < layout.colors; ++color)
    layout.planes.push_back({color,
                             make_resample_table(along, layout.columns, held_spread(width_mm, pixel_mm)),
                             make_resample_table(across, layout.rows, held_spread(height_mm, pixel_mm))});

  layout.peak = brightest_component(layout, {1, 1, 1}) / view.gain;
  const bool is_fine = std::min(width_mm, height_mm) < kMinPixelsPerPeriod * pixel_mm;
  if (structure.has_stripes && !is_fine) {
    // The pattern begins at the left and upper edge of the screen.
    const auto draw = [&](PixelGrid columns, PixelGrid rows) {
      columns.edge_mm += layout.picture_width_mm / 2;
      rows.edge_mm += layout.picture_height_mm / 2;
      return subpixels(structure, width_mm, height_mm, columns, rows, pixel_mm);
    };
    layout.peak = set_pattern(draw, width_mm, height_mm, layout) / view.gain;
  }
  if (structure.has_stripes && is_fine)
    layout.notes.push_back("the image has " + short_number(width_mm / pixel_mm) + " x " +
                           short_number(height_mm / pixel_mm) +
                           " pixels per pixel of the panel, below 2: it shows the mean of the subpixels");
  return layout;
}

}  // namespace tessera::detail
