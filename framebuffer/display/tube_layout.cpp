// Geometry of tubes: raster, beam, mask, scattered light.
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "framebuffer/display/display_color.h"
#include "framebuffer/display/gaussian.h"
#include "framebuffer/display/line_times.h"
#include "framebuffer/display/mask_pattern.h"
#include "framebuffer/display/screen_layout.h"
#include "framebuffer/display/tube_source.h"
#include "framebuffer/exact_functions.h"

namespace tessera::detail {
namespace {

constexpr double kMmPerInch = 25.4;
/// Structures with fewer pixels per period are drawn as their mean: at 2 they reach half of the sampling
/// rate.
constexpr double kMinPixelsPerPeriod = 2;
constexpr double kCellsPerSigma = 2.5;  ///< pitch of the grid of scattered light

/// The raster: a picture of the mode's shape within the 4:3 screen, enlarged by the overscan.
void place_raster(const CrtTube& tube, const VideoMode& mode, ScreenLayout& layout) {
  const double aspect = mode.pixel_aspect * mode.width / mode.height;
  const double screen_aspect = layout.screen_width_mm / layout.screen_height_mm;
  const double enlarged = 1 / (1 - tube.overscan);
  layout.picture_width_mm = layout.screen_width_mm * std::min(1.0, aspect / screen_aspect) * enlarged;
  layout.picture_height_mm = layout.screen_height_mm * std::min(1.0, screen_aspect / aspect) * enlarged;
}

/// Beam of one colour, displaced by the convergence error.
PlaneLayout beam_plane(std::size_t color, double displacement_mm, double sigma_mm, const TubeSamples& samples,
                       int lines, int width, const ScreenLayout& layout) {
  const double pixel_mm = layout.columns.pitch_mm;
  const double picture_pixel_mm = layout.picture_width_mm / width;
  const double spacing = picture_pixel_mm / samples.per_pixel;
  const double left = -layout.picture_width_mm / 2 - samples.delay_px * picture_pixel_mm + displacement_mm;
  // Samples that lie apart more than two sigma are held, so that a white row is even.
  const double held = sigma_mm < 0.5 * spacing ? spacing : 0;
  const SampleGrid along{samples.count, left + spacing / 2, spacing};
  const double line_mm = layout.picture_height_mm / lines;
  const SampleGrid across{lines, -layout.picture_height_mm / 2 + line_mm / 2, line_mm};
  const double smoothing = line_mm < kMinPixelsPerPeriod * pixel_mm ? line_mm : 0;
  return {color,
          make_resample_table(along, layout.columns, gaussian_spread(sigma_mm, spacing, pixel_mm, held)),
          make_resample_table(across, layout.rows, gaussian_spread(sigma_mm, line_mm, pixel_mm, smoothing))};
}

/// Cells that cover an axis of the image and `margin` more cells at each end.
PixelGrid coarse_grid(const PixelGrid& fine, double pitch_mm, int margin) {
  const double length = fine.count * fine.pitch_mm;
  const int cells = static_cast<int>(std::ceil(length / pitch_mm));
  return {cells + 2 * margin, fine.edge_mm - margin * pitch_mm, pitch_mm};
}

/// Weights of a Gaussian at the distances of cells. The sum of neighbours has the variance sigma^2, once
/// cells have added theirs: 1/12 of the squared pitch by their means, 1/6 by linear interpolation.
std::vector<float> cell_blur(double sigma_mm, double pitch_mm, int reach) {
  const double variance = sigma_mm * sigma_mm / (pitch_mm * pitch_mm) - 0.25;
  std::vector<double> weights;
  double sum = 0;
  for (int k = -reach; k <= reach; ++k) {
    weights.push_back(exponential(-k * k / (2 * variance)));
    sum += weights.back();
  }
  std::vector<float> blur;
  for (const double weight : weights) blur.push_back(static_cast<float>(weight / sum));
  return blur;
}

void add_scatter(const CrtTube& tube, const TubeSamples& samples, int lines, int width,
                 ScreenLayout& layout) {
  ScatterLayout& scatter = layout.scatter;
  scatter.share = tube.halation;
  const double pitch = tube.halation_mm / kCellsPerSigma;
  const int reach = static_cast<int>(4 * kCellsPerSigma);
  scatter.columns = coarse_grid(layout.columns, pitch, reach + 1);
  scatter.rows = coarse_grid(layout.rows, pitch, reach + 1);
  scatter.blur = cell_blur(tube.halation_mm, pitch, reach);
  const double spacing = layout.picture_width_mm / width / samples.per_pixel;
  const SampleGrid along{samples.count, -layout.picture_width_mm / 2 + spacing / 2, spacing};
  const double line_mm = layout.picture_height_mm / lines;
  const SampleGrid across{lines, -layout.picture_height_mm / 2 + line_mm / 2, line_mm};
  scatter.horizontal = make_resample_table(along, scatter.columns, held_spread(spacing, pitch));
  scatter.vertical = make_resample_table(across, scatter.rows, held_spread(line_mm, pitch));
}

/// Brightest point of the profile of white lines: with ripple 2 exp(-2 pi^2 sigma^2 / d^2), and averaged over
/// pixels.
double line_peak(double sigma_mm, double line_mm, double pixel_mm) {
  const double smoothing = line_mm < kMinPixelsPerPeriod * pixel_mm ? line_mm : 0;
  const SpreadFunction spread = gaussian_spread(sigma_mm, line_mm, pixel_mm, smoothing);
  double sum = 0;  // at the centre of a line
  const int reach = static_cast<int>(spread.reach_mm / line_mm) + 1;
  for (int line = -reach; line <= reach; ++line) sum += spread.light(line * line_mm);
  return sum;
}

void add_notes(const CrtTube& tube, const VideoMode& mode, double line_mm, ScreenLayout& layout) {
  const auto note = [&](const std::string& text) { layout.notes.push_back(text); };
  if (tube.mask != ShadowMask::none) {
    const double triad_mm = mask_cell(tube).triad_mm;
    if (const double pixels = triad_mm / layout.columns.pitch_mm; pixels < kMinPixelsPerPeriod)
      note("the image has " + short_number(pixels) +
           " columns per triad of the mask, below 2: it shows the mean of the mask; from " +
           short_number(kMinPixelsPerPeriod / triad_mm) + " pixels per mm on, the mask is visible");
    const double triads = layout.screen_width_mm / triad_mm;
    if (mode.width > triads)
      note("the mode has " + std::to_string(mode.width) + " columns, " +
           short_number(100 * (mode.width / triads - 1)) + " % more than the tube has triads in a row (" +
           short_number(triads) + ")");
  }
  if (const double pixels = line_mm / layout.rows.pitch_mm; pixels < kMinPixelsPerPeriod)
    note("the image has " + short_number(pixels) +
         " rows per scan line, below 2: it shows the mean of the lines");
}

}  // namespace

ScreenLayout tube_layout(const Display& display, const VideoMode& mode, const ScreenView& view) {
  const CrtTube& tube = display.crt;
  ScreenLayout layout;
  place_view(0.8 * kMmPerInch * tube.diagonal_in, 0.6 * kMmPerInch * tube.diagonal_in, view, layout);
  place_raster(tube, mode, layout);
  const FrameScan scan = frame_scan(mode, tube);
  layout.lines_per_row = scan.lines_per_row;
  const double line_mm = layout.picture_height_mm / scan.lines;
  const double beam_mm = tube.beam_mm > 0 ? tube.beam_mm : line_mm / 2;
  const double sigma_mm = beam_mm / kFwhmPerSigma;
  layout.sigma_px = sigma_mm / (layout.picture_width_mm / mode.width);
  if (is_monochrome(tube.phosphor)) set_one_color(srgb_from_phosphor(tube.phosphor), layout);
  else set_colors(srgb_from_display(tube.primaries, tube.white), layout);

  const TubeSamples samples = tube_samples(display, mode, layout.sigma_px);
  const int widths = tube.beam_growth > 0 ? 2 : 1;
  for (int width = 0; width < widths; ++width)
    for (std::size_t color = 0; color < layout.colors; ++color) {
      const double displacement =
          layout.colors == 3 ? (static_cast<double>(color) - 1) * tube.convergence_mm : 0;
      const double sigma = width == 0 ? sigma_mm : sigma_mm * (1 + tube.beam_growth);
      layout.planes.push_back(
          beam_plane(color, displacement, sigma, samples, scan.lines, mode.width, layout));
    }
  if (tube.halation > 0) add_scatter(tube, samples, scan.lines, mode.width, layout);

  // White has the widest beam, if beams grow.
  const double white_sigma = sigma_mm * (1 + tube.beam_growth);
  const double lines_peak = line_peak(white_sigma, line_mm, layout.rows.pitch_mm);
  double mask = brightest_component(layout, {1, 1, 1});
  if (tube.mask != ShadowMask::none &&
      mask_cell(tube).triad_mm >= kMinPixelsPerPeriod * layout.columns.pitch_mm) {
    const double pixel_mm = layout.columns.pitch_mm;
    const auto draw = [&](const PixelGrid& columns, const PixelGrid& rows) {
      return mask_tables(tube, columns, rows, pixel_mm);
    };
    mask = set_pattern(draw, mask_cell(tube).width_mm, mask_cell(tube).height_mm, layout);
  }
  const double even = brightest_component(layout, {1, 1, 1});
  layout.peak = ((1 - tube.halation) * lines_peak * mask + tube.halation * even) / view.gain;
  add_notes(tube, mode, line_mm, layout);
  return layout;
}

}  // namespace tessera::detail
