#include "perf/accuracy/round_timing.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>
#include <random>

#include "perf/accuracy/processor_clock.h"

namespace tessera::accuracy {
namespace {

using Clock = std::chrono::steady_clock;

double ms_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

/// Frames per turn of an alternative: its fastest of three frames, the first of which is cold, fills
/// kMinTurnMs.
int frames_per_turn(const std::function<void()>& draw) {
  double fastest = kMinTurnMs;
  for (int i = 0; i < 3; ++i) {
    const Clock::time_point start = Clock::now();
    draw();
    fastest = std::min(fastest, ms_since(start));
  }
  constexpr double kMaxFrames = 1000;
  return static_cast<int>(std::clamp(std::ceil(kMinTurnMs / std::max(fastest, 1e-6)), 1.0, kMaxFrames));
}

}  // namespace

RoundTimer::RoundTimer(std::vector<std::function<void()>> draws, const bench::HardwareCounters& counters)
    : draws_(std::move(draws)), counters_(counters) {
  for (const std::function<void()>& draw : draws_) frames_.push_back(frames_per_turn(draw));
}

Turn RoundTimer::turn(std::size_t alternative) const {
  const int frames = frames_[alternative];
  const double clock = cycles_per_ms();
  const auto counted = counters_.read();
  const double cpu_start = process_cpu_ms();
  const Clock::time_point start = Clock::now();
  for (int i = 0; i < frames; ++i) draws_[alternative]();
  const double wall_ms = ms_since(start);
  const double cpu_ms = process_cpu_ms() - cpu_start;
  double cycles = cpu_ms * clock;
  if (const auto now = counters_.read(); now && counted)
    cycles = static_cast<double>(now->cycles - counted->cycles);
  return {wall_ms / frames, cpu_ms / frames, 1e-6 * cycles / frames};
}

Round RoundTimer::run(std::uint32_t seed) const {
  std::vector<std::size_t> order(draws_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::mt19937 random(seed);
  std::shuffle(order.begin(), order.end(), random);
  Round round;
  round.turns.resize(draws_.size());
  round.opening = turn(0);
  for (const std::size_t alternative : order) round.turns[alternative] = turn(alternative);
  round.closing = turn(0);
  return round;
}

}  // namespace tessera::accuracy
