#include "perf/accuracy/time_figures.h"

#include <algorithm>

#include "perf/bench/statistics.h"

namespace tessera::accuracy {
namespace {

Interval interval_of(std::vector<double> values) {
  const bench::Statistics statistics = bench::statistics_of(std::move(values));
  return {statistics.median, statistics.median_ci_low, statistics.median_ci_high};
}

double default_ms(const Round& round) { return (round.opening.wall_ms + round.closing.wall_ms) / 2; }

TimeFigures figures_of(std::span<const ProcessRounds> processes, std::size_t alternative) {
  std::vector<double> ratios, ms, cpu_ms, cycles, medians;
  for (const ProcessRounds& rounds : processes) {
    std::vector<double> own;
    for (const Round& round : rounds) {
      const Turn& turn = round.turns[alternative];
      own.push_back(turn.wall_ms / default_ms(round));
      ms.push_back(turn.wall_ms);
      cpu_ms.push_back(turn.cpu_ms);
      cycles.push_back(turn.million_cycles);
    }
    medians.push_back(interval_of(own).median);
    ratios.insert(ratios.end(), own.begin(), own.end());
  }
  const auto [low, high] = std::minmax_element(medians.begin(), medians.end());
  return {.ratio = interval_of(std::move(ratios)),
          .ms = interval_of(std::move(ms)),
          .cpu_ms = interval_of(std::move(cpu_ms)).median,
          .million_cycles = interval_of(std::move(cycles)).median,
          .process_low = *low,
          .process_high = *high};
}

}  // namespace

std::vector<TimeFigures> time_figures(std::span<const ProcessRounds> processes) {
  std::vector<TimeFigures> figures;
  for (std::size_t k = 0; k < processes.front().front().turns.size(); ++k)
    figures.push_back(figures_of(processes, k));
  return figures;
}

bool is_told_apart(const Interval& a, const Interval& b) { return a.high < b.low || b.high < a.low; }

std::vector<std::size_t> dominating_points(std::span<const CostPoint> points) {
  std::vector<std::size_t> result;
  for (std::size_t p = 0; p < points.size(); ++p) {
    std::size_t best = p;
    for (std::size_t q = 0; q < points.size(); ++q) {
      const bool dominates = points[q].error <= points[p].error && points[q].time.high < points[p].time.low;
      if (dominates && (best == p || points[q].time.median < points[best].time.median)) best = q;
    }
    result.push_back(best);
  }
  return result;
}

}  // namespace tessera::accuracy
