#include "framebuffer/display/screen_layout.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "framebuffer/display/screen_rows.h"

namespace tessera::detail {
namespace {

constexpr int kDefaultRows = 1440;
constexpr int kMaxImageSize = 16384;

/// Length of a part from an edge on; 0 means up to the end of the screen.
double part_length(const char* name, double from_mm, double length_mm, double screen_mm) {
  const double length = length_mm == 0 ? screen_mm - from_mm : length_mm;
  // Sizes are typed with few digits, so an excess of a micrometre is tolerated.
  const bool is_inside = from_mm >= 0 && length > 0 && from_mm + length <= screen_mm + 1e-3;
  if (!is_inside)
    throw DisplayError(std::string("the part's ") + name + " is from " + short_number(from_mm) + " to " +
                       short_number(from_mm + length) + " mm, the screen has 0 to " +
                       short_number(screen_mm) + " mm");
  return length;
}

int image_size(const char* name, double length_mm, double scale) {
  const double size = std::max(std::floor(length_mm * scale + 0.5), 1.0);
  if (size > kMaxImageSize)
    throw DisplayError("at " + short_number(scale) + " pixels per mm the image has " + short_number(size) +
                       " " + name + ", at most " + std::to_string(kMaxImageSize) +
                       " are possible; choose a smaller part or scale");
  return static_cast<int>(size);
}

}  // namespace

std::string short_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.5g", value);
  return text;
}

void place_view(double width_mm, double height_mm, const ScreenView& view, ScreenLayout& layout) {
  layout.screen_width_mm = width_mm;
  layout.screen_height_mm = height_mm;
  if (!(view.scale_px_per_mm >= 0 && view.scale_px_per_mm <= 1000))
    throw DisplayError("the scale is " + short_number(view.scale_px_per_mm) +
                       " pixels per mm, expected above 0 to 1000");
  if (!(view.gain >= 0.01 && view.gain <= 100))
    throw DisplayError("the gain is " + short_number(view.gain) + ", expected 0.01 to 100");
  const double part_width = part_length("width", view.x_mm, view.width_mm, width_mm);
  const double part_height = part_length("height", view.y_mm, view.height_mm, height_mm);
  const double scale = view.scale_px_per_mm > 0 ? view.scale_px_per_mm : kDefaultRows / part_height;
  layout.columns = {image_size("columns", part_width, scale), view.x_mm - width_mm / 2, 1 / scale};
  layout.rows = {image_size("rows", part_height, scale), view.y_mm - height_mm / 2, 1 / scale};
}

void set_colors(const ColorMatrix& srgb_from_display, ScreenLayout& layout) {
  layout.colors = 3;
  for (std::size_t component = 0; component < 3; ++component)
    layout.srgb_from_light[component] = srgb_from_display.rows[component];
}

void set_one_color(const ColorValues& srgb, ScreenLayout& layout) {
  layout.colors = 1;
  for (std::size_t component = 0; component < 3; ++component)
    layout.srgb_from_light[component] = {srgb[component], 0, 0};
}

double brightest_component(const ScreenLayout& layout, const std::array<double, 3>& light) {
  double brightest = 0;
  for (const auto& row : layout.srgb_from_light) {
    double sum = 0;
    for (std::size_t color = 0; color < layout.colors; ++color) sum += row[color] * light[color];
    brightest = std::max(brightest, sum);
  }
  return brightest;
}

double set_pattern(const DrawPattern& draw, double period_x_mm, double period_y_mm, ScreenLayout& layout) {
  layout.pattern = draw(layout.columns, layout.rows);
  for (auto& terms : layout.pattern.column_factors)
    for (std::vector<float>& factors : terms) factors.resize(padded_columns(layout.columns.count));

  constexpr int kPoints = 64;  // per period
  const PatternTables period = draw({kPoints, 0, period_x_mm / kPoints}, {kPoints, 0, period_y_mm / kPoints});
  double brightest = 0;
  for (std::size_t y = 0; y < kPoints; ++y)
    for (std::size_t x = 0; x < kPoints; ++x)
      brightest =
          std::max(brightest,
                   brightest_component(layout, {period.at(0, x, y), period.at(1, x, y), period.at(2, x, y)}));
  return brightest;
}

}  // namespace tessera::detail
