// What benchmarks have in common: options, rows whose repetitions come in random order, and the ratios of
// their medians.
#pragma once

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "engine/parallel.h"
#include "engine/tessera/tessera.hpp"

namespace tessera {

/// Keeps the time of each repetition of each row, for medians and their spread.
class RatioReporter : public benchmark::ConsoleReporter {
 public:
  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs)
      if (run.run_type == Run::RT_Iteration)
        times_[run.run_name.function_name].push_back(run.GetAdjustedRealTime());
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

inline void print_ratio(const RatioReporter& reporter, const std::string& label, const std::string& slow,
                        const std::string& fast) {
  if (!reporter.has(slow) || !reporter.has(fast)) return;
  const auto s = reporter.quartiles(slow), f = reporter.quartiles(fast);
  std::printf("%-34s %8.3f ms (%.3f .. %.3f)   %8.3f ms (%.3f .. %.3f)   ratio %.2f\n", label.c_str(),
              s.median, s.low, s.high, f.median, f.low, f.high, s.median / f.median);
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

/// What `--isa=NAME` asks for, which is taken out of the arguments. Throws std::invalid_argument where the
/// machine has no such set.
inline InstructionSet take_instruction_set(std::vector<char*>& arguments) {
  constexpr std::string_view kOption = "--isa=";
  const auto is_option = [](const char* argument) { return std::string_view(argument).starts_with(kOption); };
  const auto found = std::find_if(arguments.begin() + 1, arguments.end(), is_option);
  const std::vector<InstructionSet> sets = available_instruction_sets();
  if (found == arguments.end()) return sets.front();
  const std::string_view wanted = std::string_view(*found).substr(kOption.size());
  std::string names;
  for (const InstructionSet set : sets) {
    if (name(set) == wanted) {
      arguments.erase(found);
      return set;
    }
    names.append(names.empty() ? "" : ", ").append(name(set));
  }
  throw std::invalid_argument("--isa is one of " + names + " on this machine, not '" + std::string(wanted) +
                              "'");
}

/// Takes Google Benchmark's own options and `--isa=NAME`; repetitions of all rows come in random order.
/// @return what renderers are made with: the set, and as many threads as there are cores
inline RendererOptions initialize_rows(int argc, char** argv) {
  std::vector<char*> arguments(argv, argv + argc);
  const InstructionSet instruction_set = take_instruction_set(arguments);
  static std::string interleave = "--benchmark_enable_random_interleaving=true";
  arguments.insert(arguments.begin() + 1, interleave.data());
  int count = static_cast<int>(arguments.size());
  benchmark::Initialize(&count, arguments.data());
  if (benchmark::ReportUnrecognizedArguments(count, arguments.data()))
    throw std::invalid_argument("no such option");
  return {.threads = available_cores(), .instruction_set = instruction_set};
}

/// Runs the rows; then come the heading of the ratios and that of their columns.
inline RatioReporter run_rows(const RendererOptions& options, const char* slow, const char* fast) {
  RatioReporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
  std::printf("\n%d threads, %s; medians of 31 interleaved repetitions (quartiles)\n", options.threads,
              std::string(name(options.instruction_set)).c_str());
  std::printf("%-34s %-32s %-32s\n", "", slow, fast);
  return reporter;
}

/// main(): one line for what was thrown.
template <class Run>
int run_benchmark(const char* name, const Run& run, int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", name, error.what());
    return 1;
  }
}

}  // namespace tessera
