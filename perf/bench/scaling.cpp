#include "perf/bench/scaling.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <exception>
#include <functional>
#include <iterator>
#include <limits>
#include <memory>
#include <new>
#include <queue>
#include <tuple>

#include "engine/runtime/worker_pool.h"
#include "perf/bench/bandwidth.h"
#include "perf/bench/columns.h"
#include "perf/bench/frame_costs.h"
#include "perf/bench/independent_renderers.h"
#include "perf/bench/text.h"

namespace tessera::bench {
namespace {

constexpr int kCores[] = {2, 4, 8, 16, 32, 64, 128};
constexpr double kCostSeconds = 2;   // per core count, in units of MeasureOptions::seconds
constexpr int kBreakdownCores = 64;  // core count whose time is broken down
static_assert(std::find(std::begin(kCores), std::end(kCores), kBreakdownCores) != std::end(kCores));

double length(const FrameTask& task) { return task.end - task.begin; }

/// Seconds until all tasks of a pass are done, with WorkerPool's shares and work stealing.
/// @param tasks             in task order
/// @param dispatch_seconds  per task
double makespan(std::span<const FrameTask> tasks, double dispatch_seconds, int cores) {
  const std::size_t workers = std::min(static_cast<std::size_t>(cores), tasks.size());
  std::vector<std::size_t> next;  // next task of each share
  for (std::size_t s = 0; s < workers; ++s) next.push_back(first_of_share(tasks.size(), workers, s));
  struct Core {
    double free_at = 0;
    std::size_t worker = 0;
    std::size_t shares_done = 0;  // shares found empty, counted from share `worker`
    bool operator>(const Core& other) const {
      return std::tie(free_at, worker) > std::tie(other.free_at, other.worker);
    }
  };
  std::priority_queue<Core, std::vector<Core>, std::greater<>> cores_free;
  for (std::size_t w = 0; w < workers; ++w) cores_free.push({.worker = w});
  double end = 0;
  while (!cores_free.empty()) {
    Core core = cores_free.top();
    cores_free.pop();
    const auto share = [&] { return (core.worker + core.shares_done) % workers; };
    while (core.shares_done < workers && next[share()] == first_of_share(tasks.size(), workers, share() + 1))
      ++core.shares_done;
    if (core.shares_done == workers) continue;
    core.free_at += dispatch_seconds + length(tasks[next[share()]++]);
    end = std::max(end, core.free_at);
    cores_free.push(core);
  }
  return end;
}

std::array<std::pair<const char*, double>, 4> parts_of(const FrameTimeBreakdown& seconds) {
  return {{{"busy", seconds.busy},
           {"idle", seconds.idle},
           {"serial", seconds.serial},
           {"memory", seconds.memory}}};
}

/// Minimum seconds of a pass with one empty task per worker.
double barrier_seconds(int threads) {
  constexpr int kRuns = 9;
  constexpr int kPasses = 500;
  WorkerPool worker_pool(threads);
  double min = std::numeric_limits<double>::infinity();
  for (int run = 0; run < kRuns; ++run) {
    const auto start = std::chrono::steady_clock::now();
    for (int i = 0; i < kPasses; ++i)
      worker_pool.for_each(static_cast<std::size_t>(threads), [](std::size_t, int) {});
    min = std::min(min,
                   std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() / kPasses);
  }
  return min;
}

}  // namespace

CoreModel measure_core_model(int threads) {
  constexpr std::uint64_t kBandwidthTestBytes = std::uint64_t{256} << 20;
  constexpr double kSeconds = 1;
  return {.core_gb_per_second = measure_bandwidth(Roofline::memory_copies, 1, kBandwidthTestBytes, kSeconds),
          .barrier_seconds = barrier_seconds(threads)};
}

FrameTimeBreakdown predict_frame_time(const TracedFrame& frame, int cores, const CoreModel& model) {
  FrameTimeBreakdown seconds{.serial = frame.seconds - frame.task_seconds() - frame.dispatch_seconds};
  const double dispatch =
      frame.dispatch_seconds / std::max<double>(1, static_cast<double>(frame.tasks.size()));
  const double barrier = cores > 1 ? model.barrier_seconds : 0;
  double passes = frame.untraced_calls * barrier;
  for (auto first = frame.tasks.begin(); first != frame.tasks.end();) {
    const auto last = std::find_if(first, frame.tasks.end(),
                                   [&](const FrameTask& task) { return task.pass != first->pass; });
    passes += makespan({first, last}, dispatch, cores) + barrier;
    first = last;
  }
  seconds.busy = (frame.task_seconds() + frame.dispatch_seconds) / cores;
  seconds.idle = frame.tasks.empty() ? passes : passes - seconds.busy;
  const double memory_rate =
      1e9 * model.core_gb_per_second * std::min(cores, model.bandwidth_saturating_cores);
  seconds.memory = std::max(0.0, static_cast<double>(frame.work.bytes) / memory_rate - seconds.sum());
  return seconds;
}

std::vector<int> measured_threads(int threads) {
  constexpr int kMaxConsecutive = 8;
  std::vector<int> counts;
  for (int count = 2; count < threads; count = count < kMaxConsecutive ? count + 1 : 2 * count)
    counts.push_back(count);
  if (threads > 1) counts.push_back(threads);
  return counts;
}

namespace {

/// Workload to be scaled, and how to measure it.
struct ScalingInput {
  const WorkloadEntry& entry;
  const WorkloadSetup& setup;
  const MeasureOptions& options;
  const HardwareCounters& counters;

  Candidate on_threads(int count) const {
    WorkloadSetup with = setup;
    with.options.threads = count;
    return {.name = entry.name, .make = [&make = entry.make, with] { return make(with); }, .threads = count};
  }
};

std::string first_fault(const std::vector<Row>& rows) {
  for (const Row& row : rows)
    if (!row.fault.empty()) return row.fault;
  return {};
}

/// Measures each thread count in turns with one thread; one thread alone if `counts` is empty.
void measure_threads(const ScalingInput& input, const std::vector<int>& counts, Scaling& scaling) {
  if (counts.empty()) {
    const std::vector<Row> rows = measure(std::vector{input.on_threads(1)}, input.options, input.counters);
    scaling.fault = first_fault(rows);
    scaling.one_ms = rows.front().ms.median;
  }
  for (const int count : counts) {
    const std::vector<Row> rows =
        measure(std::vector{input.on_threads(1), input.on_threads(count)}, input.options, input.counters);
    scaling.fault = first_fault(rows);
    if (!scaling.fault.empty()) return;
    scaling.one_ms = rows[0].ms.median;
    scaling.measured.emplace_back(count, ratio_of(rows[0].ms, rows[1].ms));
  }
}

/// Leaves `scaling` as it is if an error, such as too little memory, stops the measurement.
void measure_independent_renderers(const ScalingInput& input, Scaling& scaling) {
  const Candidate independent{
      .name = input.entry.name,
      .make = [&] { return std::make_unique<IndependentRenderers>(input.entry, input.setup); },
      .threads = 2};
  const std::vector<Row> rows =
      measure(std::vector{input.on_threads(1), independent}, input.options, input.counters);
  if (std::any_of(rows.begin(), rows.end(), [](const Row& row) { return row.is_aborted; })) return;
  scaling.fault = first_fault(rows);
  if (scaling.fault.empty())
    scaling.independent_renderers = IndependentRenderers::speed_up(rows[0].ms, rows[1].ms);
}

void predict_speed_ups(const ScalingInput& input, const CoreModel& model, Scaling& scaling) {
  try {
    for (const int cores : kCores) {
      const std::vector<TracedFrame> costs = measure_frame_costs(
          input.entry, input.setup, std::array{1, cores}, kCostSeconds * input.options.seconds);
      const FrameTimeBreakdown on_one_core = predict_frame_time(costs[0], 1, model);
      const FrameTimeBreakdown on_many_cores = predict_frame_time(costs[1], cores, model);
      scaling.predicted.emplace_back(cores, on_one_core.sum() / on_many_cores.sum());
      if (cores == kBreakdownCores) scaling.on_64_cores = on_many_cores;
    }
  } catch (const std::bad_alloc&) {
    scaling.not_computed = kOutOfMemory;
  } catch (const std::exception& error) {
    scaling.not_computed = error.what();
  }
}

}  // namespace

Scaling scaling_of(const WorkloadEntry& entry, const WorkloadSetup& setup, int threads,
                   const CoreModel& model, const MeasureOptions& options, const HardwareCounters& counters) {
  const ScalingInput input{entry, setup, options, counters};
  const std::vector<int> counts = measured_threads(threads);
  Scaling scaling{.workload = entry.name};
  measure_threads(input, counts, scaling);
  if (scaling.fault.empty() && !counts.empty()) measure_independent_renderers(input, scaling);
  if (scaling.fault.empty()) predict_speed_ups(input, model, scaling);
  return scaling;
}

namespace {

constexpr Column kScalingColumns[] = {
    {"1 thread ms", "median time of a frame on one thread, milliseconds"},
    {"N threads", "speed-up over one thread, measured in turns: 2 is twice as fast; its interval"},
    {"2 independent", "speed-up of two renderers that share no data, one thread each"},
    {"computed: Nx", "speed-up on N cores, predicted from the times of tasks"},
    {"of 64", "efficiency on 64 cores: predicted speed-up / 64"},
    {"busy", "share of the time on 64 cores: tasks and their dispatch"},
    {"idle", "likewise: waiting for the last task of a pass and for the next pass"},
    {"serial", "likewise: work of one core outside tasks"},
    {"memory", "likewise: memory transfers that do not overlap the rest"},
};

}  // namespace

std::string scaling_columns() { return column_lines(kScalingColumns); }

std::string scaling_heading(int threads) {
  std::string text = formatted("%-22s %11s ", "workload", "1 thread ms");
  for (const int count : measured_threads(threads))
    text += formatted(" %20s", (std::to_string(count) + " threads").c_str());
  if (threads > 1) text += formatted(" %20s", "2 independent");
  text += "  computed:";
  for (const int cores : kCores) text += formatted(" %7s", (std::to_string(cores) + "x").c_str());
  return text + "   of 64     busy     idle   serial   memory\n";
}

std::string scaling_line(const Scaling& scaling) {
  if (!scaling.fault.empty())
    return formatted("%-22s not timed: %s\n", scaling.workload.c_str(), scaling.fault.c_str());
  std::string text = formatted("%-22s %11.3f ", scaling.workload.c_str(), scaling.one_ms);
  const auto measured = [&](const Ratio& speed) {
    text += formatted(" %5.2f (%.2f .. %.2f)", speed.value, speed.low, speed.high);
  };
  for (const auto& [threads, speed] : scaling.measured) measured(speed);
  if (scaling.independent_renderers) measured(*scaling.independent_renderers);
  else if (!scaling.measured.empty()) text += formatted(" %20s", "(no memory)");
  text += "           ";
  double on_64_cores = 0;
  for (const auto& [cores, speed] : scaling.predicted) {
    text += formatted(" %7.2f", speed);
    if (cores == kBreakdownCores) on_64_cores = speed / kBreakdownCores;
  }
  if (!scaling.not_computed.empty()) return text + "  not computed: " + scaling.not_computed + "\n";
  text += formatted("  %4.0f %%", 100 * on_64_cores);
  for (const auto& [what, seconds] : parts_of(scaling.on_64_cores))
    text += formatted("  %5.0f %%", 100 * seconds / scaling.on_64_cores.sum());
  return text + "\n";
}

nlohmann::ordered_json scaling_json(const std::vector<Scaling>& all) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  const auto measured = [](const Ratio& speed) {
    return nlohmann::ordered_json{{"speed_up", speed.value}, {"low", speed.low}, {"high", speed.high}};
  };
  for (const Scaling& scaling : all) {
    nlohmann::ordered_json entry{{"name", scaling.workload}};
    if (!scaling.fault.empty()) {
      entry["fault"] = scaling.fault;
    } else {
      entry["one_thread_ms"] = scaling.one_ms;
      for (const auto& [threads, speed] : scaling.measured)
        entry["measured"][std::to_string(threads)] = measured(speed);
      if (scaling.independent_renderers)
        entry["independent_renderers"] = measured(*scaling.independent_renderers);
      if (!scaling.not_computed.empty()) entry["not_computed"] = scaling.not_computed;
      for (const auto& [cores, speed] : scaling.predicted) entry["computed"][std::to_string(cores)] = speed;
      if (scaling.on_64_cores.sum() > 0)
        for (const auto& [what, seconds] : parts_of(scaling.on_64_cores))
          entry["ms_on_64_cores"][what] = 1e3 * seconds;
    }
    json.push_back(std::move(entry));
  }
  return json;
}

}  // namespace tessera::bench
