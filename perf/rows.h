// Rows of a benchmark, their repetitions in random order, and the ratios of their medians.
#pragma once

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace tessera {

/// Keeps the time of each repetition of each row, for medians and their spread.
class RatioReporter : public benchmark::ConsoleReporter {
 public:
  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs)
      if (run.run_type == Run::RT_Iteration) times_[run.run_name.function_name].push_back(run.GetAdjustedRealTime());
  }
  struct Quartiles {
    double low, median, high;
  };
  Quartiles quartiles(const std::string& name) const {
    std::vector<double> t = times_.at(name);
    std::sort(t.begin(), t.end());
    return {t[t.size() / 4], t[t.size() / 2], t[3 * t.size() / 4]};
  }
  bool has(const std::string& name) const { return times_.count(name) != 0; }

 private:
  std::map<std::string, std::vector<double>> times_;
};

/// @param goal  0: none
inline void print_ratio(const RatioReporter& reporter, const std::string& label, const std::string& slow, const std::string& fast, double goal) {
  if (!reporter.has(slow) || !reporter.has(fast)) return;
  const auto s = reporter.quartiles(slow), f = reporter.quartiles(fast);
  std::printf("%-34s %8.3f ms (%.3f .. %.3f)   %8.3f ms (%.3f .. %.3f)   ratio %.2f", label.c_str(), s.median, s.low, s.high, f.median, f.low, f.high, s.median / f.median);
  if (goal > 0) std::printf(" (goal %.1f)", goal);
  std::printf("\n");
}

template <class Side>
void register_row(const std::string& name, std::shared_ptr<Side> side) {
  benchmark::RegisterBenchmark(name.c_str(),
                               [side](benchmark::State& state) {
                                 for (auto _ : state) side->draw();
                               })
      ->Unit(benchmark::kMillisecond)
      ->UseRealTime()
      ->Repetitions(31)
      ->MinTime(0.05);
}

/// Google Benchmark's own options, and repetitions of all rows in random order.
inline void initialize_rows(int argc, char** argv) {
  std::vector<char*> arguments(argv, argv + argc);
  static std::string interleave = "--benchmark_enable_random_interleaving=true";
  arguments.insert(arguments.begin() + 1, interleave.data());
  int count = static_cast<int>(arguments.size());
  benchmark::Initialize(&count, arguments.data());
}

}  // namespace tessera
