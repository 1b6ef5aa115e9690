#include "perf/bench/frame_costs.h"

#include <algorithm>
#include <chrono>
#include <future>
#include <limits>
#include <memory>
#include <optional>
#include <set>
#include <utility>

#include "perf/bench/cores.h"
#include "perf/bench/simulated_workers.h"

namespace tessera::bench {
namespace {

// measure_task_costs()
constexpr int kWarmUps = 3;
constexpr int kFrames = 9;
// measure_frame_costs()
constexpr int kMinCostTurns = 3;
constexpr int kFramesPerTurn = 2;

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

int passes_of(std::span<const FrameTask> tasks) {
  std::set<int> passes;
  for (const FrameTask& task : tasks) passes.insert(task.pass);
  return static_cast<int>(passes.size());
}

double length(const FrameTask& task) { return task.end - task.begin; }

WorkloadSetup with_workers(WorkloadSetup setup, const std::shared_ptr<SimulatedWorkers>& workers) {
  setup.options.threads = workers->workers();
  setup.options.executor = workers;
  return setup;
}

/// Minimum times of tasks and their dispatch, with all workers run serially on the calling thread.
class TaskCosts {
 public:
  TaskCosts(const WorkloadEntry& entry, const WorkloadSetup& setup, int workers)
      : workers_(std::make_shared<WorkersOnCallingThread>(workers)),
        workload_(entry, with_workers(setup, workers_)) {}

  /// @param counts  whether the frame enters the minimum
  void draw(bool counts) {
    workers_->take_seconds();
    workers_->take_calls();
    TracedFrame frame = workload_.draw();
    frame.dispatch_seconds = workers_->take_seconds() - frame.task_seconds();
    frame.untraced_calls = workers_->take_calls() - passes_of(frame.tasks);
    // There was no memory for the trace.
    const bool has_lost_trace = frame.tasks.empty() && min_ && !min_->tasks.empty();
    if (!counts || has_lost_trace) return;
    // Frames take fewer passes after bins have grown.
    const bool is_comparable = min_ && min_->tasks.size() == frame.tasks.size();
    if (!is_comparable) min_ = frame;
    min_->dispatch_seconds = std::min(min_->dispatch_seconds, frame.dispatch_seconds);
    for (std::size_t i = 0; i < frame.tasks.size(); ++i)
      if (length(frame.tasks[i]) < length(min_->tasks[i])) min_->tasks[i] = frame.tasks[i];
    min_->seconds = min_->dispatch_seconds + min_->task_seconds();
  }
  /// @pre a counted frame was drawn
  const TracedFrame& min() const { return *min_; }

 private:
  std::shared_ptr<WorkersOnCallingThread> workers_;
  TracedWorkload workload_;
  std::optional<TracedFrame> min_;
};

/// Minimum time of a frame outside Executor::run().
class SerialCosts {
 public:
  SerialCosts(const WorkloadEntry& entry, const WorkloadSetup& setup,
              std::shared_ptr<SimulatedWorkers> workers)
      : workers_(std::move(workers)), workload_(entry.make(with_workers(setup, workers_))) {}

  void draw(bool counts) {
    workers_->take_seconds();
    const Clock::time_point start = Clock::now();
    workload_->draw();
    const double serial = seconds_since(start) - workers_->take_seconds();
    if (counts) min_ = std::min(min_, serial);
  }
  double min() const { return min_; }

 private:
  std::shared_ptr<SimulatedWorkers> workers_;
  std::unique_ptr<Workload> workload_;
  double min_ = std::numeric_limits<double>::infinity();
};

/// Costs of a frame that is split for `workers` workers.
class FrameCosts {
 public:
  /// @param cores  logical CPUs; the calling thread is bound to the first
  FrameCosts(const WorkloadEntry& entry, const WorkloadSetup& setup, int workers,
             const std::vector<int>& cores)
      : tasks_(entry, setup, workers) {
    tasks_.draw(false);  // may also draw Drawing::initial_frame
    tasks_.draw(true);   // passes and traffic, for the caller's share
    serial_.emplace(entry, setup, workers_for_serial(workers, cores));
  }

  void take_turn() {
    for (int i = 0; i <= kFramesPerTurn; ++i) tasks_.draw(i > 0);  // the first frame warms up the caches
    for (int i = 0; i <= kFramesPerTurn; ++i) serial_->draw(i > 0);
  }
  TracedFrame min() const {
    TracedFrame frame = tasks_.min();
    frame.seconds += serial_->min();
    return frame;
  }

 private:
  std::shared_ptr<SimulatedWorkers> workers_for_serial(int workers, const std::vector<int>& cores) const {
    if (workers == 1 || cores.size() < 2) return std::make_shared<WorkersOnCallingThread>(workers);
    const TracedFrame& frame = tasks_.min();
    const auto passes = static_cast<std::size_t>(std::max(1, passes_of(frame.tasks) + frame.untraced_calls));
    return std::make_shared<WorkersOnOtherCore>(
        workers, cores.back(), frame.work.bytes / passes / static_cast<std::size_t>(workers));
  }

  TaskCosts tasks_;
  std::optional<SerialCosts> serial_;
};

}  // namespace

TracedFrame measure_task_costs(const WorkloadEntry& entry, const WorkloadSetup& setup, int workers) {
  TaskCosts costs(entry, setup, workers);
  for (int i = 0; i < kWarmUps + kFrames; ++i) costs.draw(i >= kWarmUps);
  return costs.min();
}

std::vector<TracedFrame> measure_frame_costs(const WorkloadEntry& entry, const WorkloadSetup& setup,
                                             std::span<const int> workers, double seconds) {
  return std::async(std::launch::async,
                    [&] {
                      const std::vector<int> cores = allowed_cores();
                      if (cores.size() > 1) set_thread_affinity({&cores.front(), 1});
                      std::vector<std::unique_ptr<FrameCosts>> all;
                      for (const int count : workers)
                        all.push_back(std::make_unique<FrameCosts>(entry, setup, count, cores));
                      const Clock::time_point start = Clock::now();
                      for (int turn = 0; turn < kMinCostTurns || seconds_since(start) < seconds; ++turn)
                        for (const auto& costs : all) costs->take_turn();
                      std::vector<TracedFrame> minima;
                      for (const auto& costs : all) minima.push_back(costs->min());
                      return minima;
                    })
      .get();
}

}  // namespace tessera::bench
