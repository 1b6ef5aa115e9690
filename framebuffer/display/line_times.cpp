#include "framebuffer/display/line_times.h"

#include <array>
#include <cmath>
#include <numbers>

#include "framebuffer/exact_functions.h"

namespace tessera::detail {
namespace {

/// Share of the light of an excitation at time 0 that is emitted before time t.
double emitted_share(double t, double decay_ms) { return t <= 0 ? 0 : 1 - exponential(-t / decay_ms); }

double emitted_between(double from, double to, double decay_ms) {
  return emitted_share(to, decay_ms) - emitted_share(from, decay_ms);
}

}  // namespace

ScanTiming default_timing(int width, int height) {
  ScanTiming timing;
  timing.total_columns = width + (width + 3) / 4;
  timing.total_lines = height + (height + 19) / 20;
  timing.pixel_clock_hz = 60.0 * timing.total_columns * timing.total_lines;
  return timing;
}

FrameScan frame_scan(const VideoMode& mode, const CrtTube& tube) {
  const ScanTiming timing = mode.timing.value_or(default_timing(mode.width, mode.height));
  FrameScan scan{};
  scan.lines_per_row = tube.lines_per_row > 0 ? tube.lines_per_row : timing.lines_per_row;
  scan.lines = mode.height * scan.lines_per_row;
  scan.interlaced =
      tube.interlace == Interlace::as_mode ? timing.interlaced : tube.interlace == Interlace::on;
  scan.frame_ms = 1000 / timing.frame_rate_hz();
  // A tube that scans rows more or less often than the mode says does so in the same time.
  const double lines_in_all =
      static_cast<double>(timing.total_lines) * scan.lines_per_row / timing.lines_per_row;
  scan.line_ms = scan.frame_ms / lines_in_all;
  scan.pixel_clock_hz = timing.pixel_clock_hz;
  return scan;
}

std::array<double, 3> decay_ms(Phosphor phosphor) {
  // Times to 10 % of the light; an exponential as a first model. P22: sources differ threefold.
  const auto to_tenth = [&]() -> std::array<double, 3> {
    switch (phosphor) {
      case Phosphor::p1: return {24, 24, 24};
      case Phosphor::p39: return {150, 150, 150};
      case Phosphor::p31: return {.038, .038, .038};
      case Phosphor::p4:  // no source: as P11
      case Phosphor::p11: return {.05, .05, .05};
      case Phosphor::p22: break;
    }
    return {2, .3, .04};
  }();
  return {to_tenth[0] / std::numbers::ln10, to_tenth[1] / std::numbers::ln10,
          to_tenth[2] / std::numbers::ln10};
}

bool outlasts_frame(Phosphor phosphor) { return phosphor == Phosphor::p1 || phosphor == Phosphor::p39; }

CollectedShares collected_shares(double from_ms, double to_ms, double line_ms, double frame_ms,
                                 double decay_ms) {
  const auto share = [&](double excited_ms) {
    return emitted_between(from_ms - excited_ms, to_ms - excited_ms, decay_ms);
  };
  return {share(line_ms) + share(line_ms + frame_ms), share(line_ms - frame_ms)};
}

}  // namespace tessera::detail
