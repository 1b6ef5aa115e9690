#include "perf/bench/measure.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <limits>
#include <new>
#include <random>

#include "perf/bench/bandwidth.h"
#include "perf/bench/reference_work.h"
#include "perf/bench/resident_memory.h"

namespace tessera::bench {
namespace {

using Clock = std::chrono::steady_clock;
double ms_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

// Frames per row if MeasureOptions::seconds decides.
constexpr int kMinTurns = 15;
constexpr int kMaxTurns = 10000;

/// Runs a workload, one of its rooflines, or the reference work.
struct Runner {
  std::unique_ptr<Workload> workload{};
  std::optional<BandwidthKernel> roofline{};
  std::optional<ReferenceWork> reference{};
  double Row::*rate = nullptr;  // member that receives the roofline's result
  std::size_t row = 0;          // index of the row that receives the results
  FrameStats stats{};           // statistics of the workload's last frame
  std::vector<double> times{};  // ms
  HardwareCounters::Counts counted{};

  void draw() {
    if (roofline) roofline->run();
    else if (reference) reference->run();
    else stats = workload->draw();
  }
};

/// Number of turns of `ms` each that fit in `seconds`, but from kMinTurns to kMaxTurns.
int turns_for(double seconds, double ms) {
  const double turns = 1000 * seconds / std::max(ms, 0.001);
  return static_cast<int>(std::clamp<double>(turns, kMinTurns, kMaxTurns));
}

std::uint64_t saturating_difference(std::uint64_t a, std::uint64_t b) { return a > b ? a - b : 0; }

/// Draws at least three frames. Returns the time of the last one in ms.
double warm_up(Runner& runner, double seconds) {
  double frame_ms = 0;
  const Clock::time_point start = Clock::now();
  for (int i = 0; i < 3 || ms_since(start) < 1000 * seconds; ++i) {
    const Clock::time_point begin = Clock::now();
    runner.draw();
    frame_ms = ms_since(begin);
  }
  return frame_ms;
}

/// Runs `function`. Returns the text of its exception, or an empty string.
/// An error ends one row, not the table.
template <class Function>
std::string error_of(const Function& function) {
  try {
    function();
  } catch (const std::bad_alloc&) {
    return kOutOfMemory;
  } catch (const std::exception& error) {
    return error.what();
  }
  return {};
}

/// Makes the workload and draws the cold first frame.
void draw_first(const Candidate& candidate, Runner& runner, Row& row) {
  reset_peak();
  const std::uint64_t before = resident_memory().now;
  runner.workload = candidate.make();
  reset_peak();  // excludes temporary memory of make()
  const std::uint64_t made = resident_memory().now;
  const Clock::time_point start = Clock::now();
  runner.draw();
  row.cold_ms = ms_since(start);
  const std::uint64_t peak = resident_memory().peak;
  const std::uint64_t frame_buffer = runner.workload->work(runner.stats).frame_buffer_bytes;
  row.peak_bytes = saturating_difference(peak, before);
  row.working_bytes = saturating_difference(peak, made + frame_buffer);
}
std::string picture_fault(const Candidate& candidate, Workload& workload) {
  std::string fault = workload.fault();
  return fault.empty() && candidate.validate ? candidate.validate(workload.picture()) : fault;
}

/// Adds a runner for each roofline. A run moves about 256 MiB. That takes a millisecond or more even in
/// caches, so starting the threads is a negligible part of it.
/// @param current_row  set to the row whose turn it is, also on an exception
void add_rooflines(std::vector<Runner>& runners, const std::vector<Row>& rows, std::size_t& current_row) {
  constexpr std::uint64_t kMovedBytes = std::uint64_t{256} << 20;
  const auto add = [&](const FrameWork& work, double Row::*rate) {
    try {
      runners.push_back({.roofline = bandwidth_kernel_for(work, rows[current_row].threads, kMovedBytes),
                         .rate = rate,
                         .row = current_row});
    } catch (const std::bad_alloc&) {
      // Keep the row; its roofline stays 0.
    }
  };
  for (current_row = 0; current_row < rows.size(); ++current_row) {
    const Runner& runner = runners[current_row];
    const FrameWork work = runner.workload->work(runner.stats);
    if (work.roofline != Roofline::none) add(work, &Row::roofline);
    if (work.roofline == Roofline::tile_stores) add({.roofline = Roofline::l1_stores}, &Row::l1_stores);
  }
}

/// Adds the reference work and its turns: they take about a fifth of options.seconds, in few runs if there
/// are few frames, because a frame is drawn untimed after each.
void add_reference(std::vector<Runner>& runners, std::vector<std::size_t>& turns, int threads, int frames,
                   const MeasureOptions& options) {
  constexpr double kShareOfSeconds = 0.2;
  const int runs = std::min(frames, std::clamp(frames / 10, 5, 20));
  try {
    ReferenceWork reference(threads, kShareOfSeconds * options.seconds / runs);
    reference.run();  // starts the threads
    turns.insert(turns.end(), static_cast<std::size_t>(runs), runners.size());
    runners.push_back({.reference = std::move(reference)});
  } catch (const std::bad_alloc&) {
    // Keep the rows; their reference time stays 0.
  }
}

/// Times all runners in random turns: the same number of frames of each workload. Rooflines take no more
/// turns than fit in options.seconds (at least kMinTurns).
/// @param threads      of the reference work
/// @param current_row  set to the row whose turn it is, also on an exception
void draw_in_turns(std::vector<Runner>& runners, int threads, const MeasureOptions& options,
                   const HardwareCounters& counters, std::size_t& current_row) {
  // All workloads get the same number of frames. Otherwise most frames of the faster workload would follow
  // another of its frames, and most frames of the slower one a frame of the other.
  int frames = std::numeric_limits<int>::max();
  std::vector<std::size_t> turns;
  for (std::size_t k = 0; k < runners.size(); ++k) {
    current_row = runners[k].row;
    const double warm_up_seconds = std::min(options.warm_up_seconds, options.seconds);
    const int max_turns = turns_for(options.seconds, warm_up(runners[k], warm_up_seconds));
    if (!runners[k].roofline) frames = std::min(frames, options.repeats > 0 ? options.repeats : max_turns);
    else  // rooflines follow all workloads, so `frames` is final
      turns.insert(turns.end(), static_cast<std::size_t>(std::min(frames, max_turns)), k);
  }
  for (std::size_t k = 0; k < runners.size(); ++k)
    if (!runners[k].roofline) turns.insert(turns.end(), static_cast<std::size_t>(frames), k);
  if (options.measures_reference) add_reference(runners, turns, threads, frames, options);
  std::mt19937 random(options.seed);
  std::shuffle(turns.begin(), turns.end(), random);
  std::optional<std::size_t> last;
  for (const std::size_t k : turns) {
    Runner& runner = runners[k];
    current_row = runner.row;
    if (last != k) runner.draw();  // warms up caches and threads again
    last = k;
    const std::optional<HardwareCounters::Counts> before = counters.read();
    const Clock::time_point start = Clock::now();
    runner.draw();
    runner.times.push_back(ms_since(start));
    if (const std::optional<HardwareCounters::Counts> after = counters.read(); before && after) {
      runner.counted.cycles += after->cycles - before->cycles;
      runner.counted.instructions += after->instructions - before->instructions;
    }
  }
}

}  // namespace

std::vector<Row> measure(std::span<const Candidate> candidates, const MeasureOptions& options,
                         const HardwareCounters& counters) {
  std::vector<Row> rows;
  for (const Candidate& candidate : candidates)
    rows.push_back({.name = candidate.name, .threads = candidate.threads});
  std::vector<Runner> runners(candidates.size());
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    runners[k].row = k;
    std::string fault;
    const std::string error = error_of([&] {
      draw_first(candidates[k], runners[k], rows[k]);
      fault = picture_fault(candidates[k], *runners[k].workload);
    });
    rows[k].fault = error.empty() ? fault : error;
    rows[k].is_aborted = !error.empty();
  }
  const auto has_fault = [](const Row& row) { return !row.fault.empty(); };
  if (std::any_of(rows.begin(), rows.end(), has_fault)) return rows;
  std::size_t current_row = 0;
  const std::string error = error_of([&] {
    if (options.measures_rooflines) add_rooflines(runners, rows, current_row);
    draw_in_turns(runners, rows.front().threads, options, counters, current_row);
  });
  if (!error.empty()) {
    rows[current_row].fault = error;
    rows[current_row].is_aborted = true;
    return rows;
  }
  for (Runner& runner : runners) {
    Row& row = rows[runner.row];
    const Statistics ms = statistics_of(runner.times);
    if (runner.reference) {
      for (Row& each : rows) each.reference_ms = ms.median / static_cast<double>(runner.reference->units());
      continue;
    }
    if (runner.roofline) {
      row.*runner.rate = runner.roofline->bytes() / ms.median * 1e-6;
      continue;
    }
    row.frames = runner.times.size();
    row.ms = ms;
    row.work = runner.workload->work(runner.stats);
    if (counters.read())
      row.counts = HardwareCounters::Counts{runner.counted.cycles / row.frames,
                                            runner.counted.instructions / row.frames};
  }
  return rows;
}

}  // namespace tessera::bench
