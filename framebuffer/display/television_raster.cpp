#include "framebuffer/display/television_raster.h"

#include <algorithm>
#include <cmath>

namespace tessera::detail {
namespace {

constexpr double kLineRateTolerance = .03;

double snapped_to_quarter(double cycles, double tolerance) {
  const double nearest = std::round(4 * cycles) / 4;
  return std::abs(cycles - nearest) <= tolerance ? nearest : cycles;
}

double fraction(double x) { return x - std::floor(x); }

bool has_line_rate(const TelevisionSystem& system, const VideoMode& mode) {
  if (!mode.timing) return false;
  const double line_rate = system.subcarrier_hz / system.cycles_per_line;
  return std::abs(mode.timing->line_rate_hz() / line_rate - 1) <= kLineRateTolerance;
}

}  // namespace

TelevisionRaster::TelevisionRaster(const TelevisionSystem& system, const VideoMode& mode) : system_(system) {
  if (has_line_rate(system, mode)) keep_timing(mode);
  else broadcast(mode);

  const int shown_lines = mode.height * lines_per_row_;
  lines_ = std::max(lines_, shown_lines);
  const int shown_per_field = interlaced_ ? (shown_lines + 1) / 2 : shown_lines;
  const int lines_per_field = interlaced_ ? lines_ / 2 : lines_;
  const int centred = system.first_line + (system.rows_per_field - shown_per_field) / 2;
  first_line_ = std::max(0, std::min(centred, lines_per_field - shown_per_field));

  samples_ = static_cast<int>(std::ceil(mode.width * samples_per_pixel_ - 1e-6));
  const double rate_mhz = 4e-6 * system.subcarrier_hz;
  const double left = system.active_start_us * rate_mhz;
  const double unused = system.active_us * rate_mhz - samples_;
  first_sample_ = std::max(0, static_cast<int>(std::lround(left + unused / 2)));
}

void TelevisionRaster::keep_timing(const VideoMode& mode) {
  const ScanTiming& timing = *mode.timing;
  // Pixel clocks that derive from the subcarrier are often given with six or seven digits.
  const double cycles = system_.subcarrier_hz / timing.line_rate_hz();
  cycles_per_line_ = snapped_to_quarter(cycles, cycles * 1e-6);
  samples_per_pixel_ = 4 * cycles_per_line_ / timing.total_columns;
  lines_ = timing.total_lines;
  lines_per_row_ = timing.lines_per_row;
  interlaced_ = timing.interlaced;
}

void TelevisionRaster::broadcast(const VideoMode& mode) {
  cycles_per_line_ = system_.cycles_per_line;
  samples_per_pixel_ = 4e-6 * system_.active_us * system_.subcarrier_hz / mode.width;
  const int blank_lines = system_.lines - 2 * system_.rows_per_field;  // odd
  lines_ = std::max(system_.lines, 2 * ((mode.height + 1) / 2) + blank_lines);
  interlaced_ = true;
}

// Row 0 is in the first field, row 1 in the second, which begins in the middle of a line.
ScanLine TelevisionRaster::line_of_row(int row, int repeat) const {
  const int shown = row * lines_per_row_ + repeat;
  if (!interlaced_) return {first_line_ + shown, row};
  return {first_line_ + shown / 2 + shown % 2 * ((lines_ + 1) / 2), row};
}

ScanLine TelevisionRaster::line_before_row(int row, int distance) const {
  const int shown = row * lines_per_row_;
  const int step = interlaced_ ? 2 : 1;
  const int before = std::max(shown % step, shown - distance * step);
  return {line_of_row(row).number - distance, before / lines_per_row_};
}

double TelevisionRaster::subcarrier_degrees(std::int64_t frame, int line) const {
  const double per_frame = fraction(snapped_to_quarter(cycles_per_line_ * lines_, 1e-6));
  const double cycles = fraction(static_cast<double>(frame) * per_frame) + fraction(line * cycles_per_line_);
  return 360 * fraction(cycles) - 90;
}

int TelevisionRaster::v_sign(std::int64_t frame, int line) const {
  const bool is_odd = ((frame % 2 * lines_ + line) % 2) != 0;
  return system_.alternates_v && is_odd ? -1 : 1;
}

}  // namespace tessera::detail
