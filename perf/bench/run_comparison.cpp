#include "perf/bench/run_comparison.h"

#include <algorithm>

namespace tessera::bench {

Ratio earlier_over_now(const RowTimes& earlier, const RowTimes& now) {
  Ratio ratio{earlier.median / now.median, earlier.low / now.high, earlier.high / now.low};
  const bool has_reference = earlier.reference > 0 && now.reference > 0;
  const double drift = has_reference ? now.reference / earlier.reference : 1;  // above 1: now is slower
  double widening = has_reference ? 1 : kUnknownDrift;
  if (std::min(earlier.frames, now.frames) < kEnoughFrames) widening *= kFewFramesFactor;
  ratio.low *= std::min(drift, 1.0) / widening;
  ratio.high *= std::max(drift, 1.0) * widening;
  return ratio;
}

bool is_slower(const Ratio& earlier_over_now, double allowed) {
  return earlier_over_now.high * (1 + allowed) < 1;
}

const char* verdict_of(const Ratio& earlier_over_now, double allowed) {
  if (is_slower(earlier_over_now, allowed)) return "slower";
  if (earlier_over_now.low > 1 + allowed) return "faster";
  const bool is_within = earlier_over_now.low * (1 + allowed) >= 1 && earlier_over_now.high <= 1 + allowed;
  return is_within ? "same" : "unsure";
}

Ratio joined(const Ratio& a, const Ratio& b) {
  return {a.value, std::min(a.low, b.low), std::max(a.high, b.high)};
}

}  // namespace tessera::bench
