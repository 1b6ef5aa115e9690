#include "framebuffer/display/television_sync.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "framebuffer/trigonometry.h"

namespace tessera::detail {
namespace {

enum class Pulse { none, line, equalizing, broad };

/// The pulse at the beginning of a half line, which is counted from the beginning of the frame.
Pulse pulse_of(const TelevisionSystem& system, const TelevisionRaster& raster, int half_line) {
  const int per_field = raster.interlaced() ? raster.lines() : 2 * raster.lines();
  const int from_broad = (half_line - system.first_broad_half_line + per_field) % per_field;
  if (from_broad < system.broad) return Pulse::broad;
  if (from_broad < 2 * system.broad || from_broad >= per_field - system.equalizing_before)
    return Pulse::equalizing;
  return half_line % 2 == 0 ? Pulse::line : Pulse::none;
}

bool has_field_sync(const TelevisionSystem& system, const TelevisionRaster& raster, int line) {
  return pulse_of(system, raster, 2 * line) != Pulse::line ||
         pulse_of(system, raster, 2 * line + 1) != Pulse::none;
}

/// Positions in a line, in samples.
struct LineClock {
  double samples_per_us;
  double half_line;

  int at(double microseconds) const { return static_cast<int>(std::lround(microseconds * samples_per_us)); }
};
LineClock line_clock(const TelevisionSystem& system, const TelevisionRaster& raster) {
  return {4e-6 * system.subcarrier_hz, 2 * raster.cycles_per_line()};
}

double pulse_length(const TelevisionSystem& system, const LineClock& clock, Pulse pulse) {
  switch (pulse) {
    case Pulse::line: return system.sync_us * clock.samples_per_us;
    case Pulse::equalizing: return system.equalizing_us * clock.samples_per_us;
    case Pulse::broad: return clock.half_line - system.sync_us * clock.samples_per_us;
    default: return 0;
  }
}

void add_pulse(double begin, double length, double level, int count, float* samples) {
  const double end = begin + length;
  for (int i = static_cast<int>(begin); i < end && i < count; ++i)
    samples[i] += static_cast<float>(level * (std::min(end, i + 1.0) - std::max<double>(begin, i)));
}

/// First sample after the burst.
int burst_end(const TelevisionSystem& system, const LineClock& clock) {
  return clock.at(system.burst_start_us) + 4 * system.burst_cycles;
}

/// The burst has the phase of -U; PAL's also that of V, in the line's sign.
void add_burst(const TelevisionSystem& system, const TelevisionRaster& raster, std::int64_t frame, int line,
               float* samples) {
  const LineClock clock = line_clock(system, raster);
  const double burst_degrees = system.alternates_v ? 180 - 45 * raster.v_sign(frame, line) : 180;
  const double subcarrier_degrees = raster.subcarrier_degrees(frame, line);
  for (int i = clock.at(system.burst_start_us); i < burst_end(system, clock); ++i) {
    const double degrees = subcarrier_degrees + 90 * (i - raster.first_sample()) + burst_degrees;
    samples[i] += static_cast<float>(system.burst_peak * sine_cosine(degrees).sine);
  }
}

}  // namespace

SignalLevels signal_levels(const TelevisionSystem& system, const Television& television) {
  const bool has_setup = system.setup > 0 && television.setup_ire >= 0;
  return {has_setup ? television.setup_ire : system.setup, system.white};
}

VideoSignal blank_frame(const TelevisionSystem& system, const Television& television,
                        const TelevisionRaster& raster, std::int64_t frame) {
  VideoSignal signal;
  signal.samples_per_line = static_cast<int>(4 * raster.cycles_per_line());
  signal.lines = raster.lines();
  signal.sample_rate_hz = 4 * system.subcarrier_hz;
  signal.unit = system.unit;
  signal.first_sample = raster.first_sample();
  signal.samples_per_pixel = raster.samples_per_pixel();
  const bool is_composite = television.cable == VideoCable::composite;
  const auto line_size = static_cast<std::size_t>(signal.samples_per_line);
  const std::size_t size = line_size * static_cast<std::size_t>(signal.lines);
  signal.samples.resize(size);
  if (!is_composite) signal.chroma.resize(size);

  const LineClock clock = line_clock(system, raster);
  for (int line = 0; line < signal.lines; ++line) {
    const std::size_t start = static_cast<std::size_t>(line) * line_size;
    float* const samples = signal.samples.data() + start;
    for (const int half : {0, 1}) {
      const Pulse pulse = pulse_of(system, raster, 2 * line + half);
      const double length = pulse_length(system, clock, pulse);
      add_pulse(half * clock.half_line, length, system.sync, signal.samples_per_line, samples);
    }
    float* const burst = is_composite ? samples : signal.chroma.data() + start;
    if (!has_field_sync(system, raster, line)) add_burst(system, raster, frame, line, burst);
  }
  return signal;
}

void insert_picture(const TelevisionSystem& system, const SignalLevels& levels,
                    const TelevisionRaster& raster, const SampleRange& range, const WireLine& wires, int line,
                    VideoSignal& signal) {
  const LineClock clock = line_clock(system, raster);
  const std::size_t start =
      static_cast<std::size_t>(line) * static_cast<std::size_t>(signal.samples_per_line);
  float* const samples = signal.samples.data() + start;
  const int first = raster.first_sample(), last = first + raster.samples();
  const int black_first =
      std::max(burst_end(system, clock), std::min(clock.at(system.active_start_us), first));
  const int active_end = clock.at(system.active_start_us) + clock.at(system.active_us);
  const int black_last = std::min(signal.samples_per_line, std::max(active_end, last));
  std::fill(samples + black_first, samples + black_last, static_cast<float>(levels.black));

  const double scale = levels.white - levels.black;
  const int wire_first = std::max(burst_end(system, clock), first + range.first);
  const int wire_last = std::min(signal.samples_per_line, first + range.first + range.count);
  for (int i = wire_first; i < wire_last; ++i) {
    const auto k = static_cast<std::size_t>(i - first - range.first);
    samples[i] += static_cast<float>(scale * wires.luma[k]);
    if (!wires.chroma.empty())
      signal.chroma[start + static_cast<std::size_t>(i)] += static_cast<float>(scale * wires.chroma[k]);
  }
}

}  // namespace tessera::detail
