#include "perf/bench/measure.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <new>
#include <random>

#include "perf/bench/resident_memory.h"

namespace tessera::bench {
namespace {

using Clock = std::chrono::steady_clock;
double ms_since(Clock::time_point start) { return std::chrono::duration<double, std::milli>(Clock::now() - start).count(); }

constexpr int kFewestFrames = 15, kMostFrames = 1000000;

struct Runner {
  std::unique_ptr<Workload> workload;
  std::vector<double> times{};
  HardwareCounters::Counts counted{};
};

int frames_for(const MeasureOptions& options, double ms) {
  if (options.repeats > 0) return options.repeats;
  return static_cast<int>(std::clamp(1000 * options.seconds / std::max(ms, 0.001), static_cast<double>(kFewestFrames), 1e4));
}

std::uint64_t above(std::uint64_t bytes, std::uint64_t others) { return bytes > others ? bytes - others : 0; }

double warm_up(Workload& workload, double seconds) {
  double frame = 0;
  const Clock::time_point start = Clock::now();
  for (int i = 0; i < 3 || ms_since(start) < 1000 * seconds; ++i) {
    const Clock::time_point begin = Clock::now();
    workload.draw();
    frame = ms_since(begin);
  }
  return frame;
}

/// What stops a workload (no memory, say), in one line; empty: nothing does. Other rows of the table go on.
template <class Work>
std::string fault_of(const Work& work) {
  try {
    work();
  } catch (const std::bad_alloc&) {
    return "out of memory";
  } catch (const std::exception& error) {
    return error.what();
  }
  return {};
}

/// The first frame.
void draw_first(const Candidate& candidate, Runner& runner, Row& row) {
  forget_peak();
  const std::uint64_t before = resident_memory().now;
  runner.workload = candidate.make();
  forget_peak();  // what was needed to make it only is given back
  const std::uint64_t made = resident_memory().now;
  const Clock::time_point start = Clock::now();
  row.stats = runner.workload->draw();
  row.cold_ms = ms_since(start);
  const std::uint64_t peak = resident_memory().peak, kept = runner.workload->work(row.stats).kept_bytes;
  row.peak_bytes = above(peak, before);
  row.working_bytes = above(peak, made + kept);
}
std::string picture_fault(const Candidate& candidate, Workload& workload) {
  std::string fault = workload.fault();
  return fault.empty() && candidate.judge ? candidate.judge(workload.picture()) : fault;
}

/// Frames that are timed, as many of each, in turns.
/// @param drawing  whose turn it is
void draw_in_turns(std::vector<Runner>& runners, std::vector<Row>& rows, const MeasureOptions& options, const HardwareCounters& counters, std::size_t& drawing) {
  // As many turns each, or the frames of the faster one would mostly follow its own, and those of the slower one the other's.
  int frames = kMostFrames;
  for (drawing = 0; drawing < runners.size(); ++drawing) frames = std::min(frames, frames_for(options, warm_up(*runners[drawing].workload, options.warm_up_seconds)));
  std::vector<std::size_t> turns;
  for (std::size_t k = 0; k < runners.size(); ++k) turns.insert(turns.end(), static_cast<std::size_t>(frames), k);
  std::mt19937 random(options.seed);
  std::shuffle(turns.begin(), turns.end(), random);
  std::optional<std::size_t> last;
  for (const std::size_t k : turns) {
    drawing = k;
    Runner& runner = runners[k];
    if (last != k) runner.workload->draw();  // caches and threads are its own again
    last = k;
    const std::optional<HardwareCounters::Counts> before = counters.read();
    const Clock::time_point start = Clock::now();
    rows[k].stats = runner.workload->draw();
    runner.times.push_back(ms_since(start));
    if (const std::optional<HardwareCounters::Counts> after = counters.read(); before && after) {
      runner.counted.cycles += after->cycles - before->cycles;
      runner.counted.instructions += after->instructions - before->instructions;
    }
  }
}

}  // namespace

std::vector<Row> measure(std::span<const Candidate> candidates, const MeasureOptions& options, const HardwareCounters& counters) {
  std::vector<Row> rows;
  for (const Candidate& candidate : candidates) rows.push_back({.name = candidate.name, .threads = candidate.threads});
  std::vector<Runner> runners(candidates.size());
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    std::string fault;
    const std::string stopped = fault_of([&] {
      draw_first(candidates[k], runners[k], rows[k]);
      fault = picture_fault(candidates[k], *runners[k].workload);
    });
    rows[k].fault = stopped.empty() ? fault : stopped;
  }
  const auto has_fault = [](const Row& row) { return !row.fault.empty(); };
  if (std::any_of(rows.begin(), rows.end(), has_fault)) return rows;
  std::size_t drawing = 0;
  if (const std::string stopped = fault_of([&] { draw_in_turns(runners, rows, options, counters, drawing); }); !stopped.empty()) {
    rows[drawing].fault = stopped;
    return rows;
  }
  for (std::size_t k = 0; k < rows.size(); ++k) {
    Row& row = rows[k];
    Runner& runner = runners[k];
    row.frames = runner.times.size();
    row.ms = statistics_of(std::move(runner.times));
    row.work = runner.workload->work(row.stats);
    if (counters.read()) row.counts = HardwareCounters::Counts{runner.counted.cycles / row.frames, runner.counted.instructions / row.frames};
  }
  return rows;
}

}  // namespace tessera::bench
