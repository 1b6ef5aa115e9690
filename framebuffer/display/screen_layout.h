// Geometry of a screen in an image: where rows and samples of light fall, which structure they show.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "framebuffer/display/light_pattern.h"
#include "framebuffer/display/resample_table.h"
#include "framebuffer/tessera/display.hpp"
#include "framebuffer/tessera/rgb_primaries.hpp"
#include "framebuffer/tessera/screen.hpp"

namespace tessera::detail {

/// Light of one colour that spreads in one way.
struct PlaneLayout {
  std::size_t color;         ///< 0 to ScreenLayout::colors - 1
  ResampleTable horizontal;  ///< samples of a row -> columns of the image
  ResampleTable vertical;    ///< scan lines -> rows of the image
};

/// Light that the glass of a tube scatters, on a grid that is coarser than the image: the mean light of
/// cells, blurred, then interpolated linearly between the centres of cells.
struct ScatterLayout {
  double share = 0;             ///< scattered share of the light; 0: no scattering, and the rest is empty
  PixelGrid columns{}, rows{};  ///< cells; they reach beyond the image as far as the blur
  ResampleTable horizontal, vertical;
  std::vector<float> blur;  ///< weights of neighbours, the cell itself in the middle; their sum is 1
};

struct ScreenLayout {
  PixelGrid columns{}, rows{};  ///< pixels of the image, from the centre of the screen
  double screen_width_mm = 0, screen_height_mm = 0;
  double picture_width_mm = 0, picture_height_mm = 0;  ///< size of the mode's picture, centred on the screen
  double sigma_px = 0;                                 ///< tubes: the beam, in pixels of the mode
  int lines_per_row = 1;                               ///< scan lines per row of pixels
  std::size_t colors = 3;
  std::vector<PlaneLayout> planes;
  PatternTables pattern;  ///< phosphors or subpixels; without terms: none
  ScatterLayout scatter;
  /// Linear sRGB of light 1 of each colour, white with Y = 1: [component][color].
  std::array<std::array<double, 3>, 3> srgb_from_light{};
  double peak = 1;  ///< largest component of a white picture, in linear sRGB, over the view's gain
  std::vector<std::string> notes;
};

/// @throws DisplayError  for views beyond the screen, and for images with more than 16384 columns or rows
ScreenLayout tube_layout(const Display& display, const VideoMode& mode, const ScreenView& view);
ScreenLayout panel_layout(const Display& display, const VideoMode& mode, const ScreenView& view);

// Steps that tubes and panels share.

/// Sets the size of the screen, and the pixels of the image.
void place_view(double width_mm, double height_mm, const ScreenView& view, ScreenLayout& layout);

void set_colors(const ColorMatrix& srgb_from_display, ScreenLayout& layout);
void set_one_color(const ColorValues& srgb, ScreenLayout& layout);

/// Largest component of light in linear sRGB.
double brightest_component(const ScreenLayout& layout, const std::array<double, 3>& light);

/// Draws a pattern for the centres of pixels.
using DrawPattern = std::function<PatternTables(const PixelGrid& columns, const PixelGrid& rows)>;

/// Sets the pattern of the image.
/// @return the largest component of white light, over one period of the pattern
double set_pattern(const DrawPattern& draw, double period_x_mm, double period_y_mm, ScreenLayout& layout);

/// A number with up to five digits, for notes and errors.
std::string short_number(double value);

}  // namespace tessera::detail
