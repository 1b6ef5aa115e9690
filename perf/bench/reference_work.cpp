#include "perf/bench/reference_work.h"

#include <algorithm>
#include <chrono>

namespace tessera::bench {
namespace {

constexpr std::size_t kFloats = std::size_t{64} << 10;  // 256 KiB per thread

/// One unit. The values stay within 1 to 2, so no operation is slower than another.
void pass_over(std::vector<float>& values) {
  for (float& value : values) value = value * 0.5f + 0.75f;
  asm volatile("" : : "r"(values.data()) : "memory");  // counts as a use of all values
}

}  // namespace

ReferenceWork::ReferenceWork(int threads, double seconds)
    : worker_pool_(threads), memory_(static_cast<std::size_t>(threads), std::vector<float>(kFloats, 1.0f)) {
  using Clock = std::chrono::steady_clock;
  constexpr int kTrials = 5;
  double unit_seconds = seconds;
  for (int trial = 0; trial < kTrials; ++trial) {  // the fastest trial is the least disturbed
    const Clock::time_point start = Clock::now();
    pass_over(memory_.front());
    unit_seconds = std::min(unit_seconds, std::chrono::duration<double>(Clock::now() - start).count());
  }
  constexpr double kMaxUnits = 1e6;
  const double per_thread = std::clamp(seconds / std::max(unit_seconds, 1e-9), 1.0, kMaxUnits);
  units_ = static_cast<std::size_t>(per_thread) * memory_.size();
}

void ReferenceWork::run() {
  worker_pool_.for_each(
      units_, [this](std::size_t, int worker) { pass_over(memory_[static_cast<std::size_t>(worker)]); });
}

}  // namespace tessera::bench
