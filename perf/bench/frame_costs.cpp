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
#include "perf/bench/pretended_workers.h"

namespace tessera::bench {
namespace {

constexpr int kWarmUps = 3, kFrames = 9;             // of one workload
constexpr int kFewestTurns = 3, kFramesOfATurn = 2;  // of several

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

WorkloadSetup with_workers(WorkloadSetup setup, const std::shared_ptr<PretendedWorkers>& workers) {
  setup.options.threads = workers->workers();
  setup.options.executor = workers;
  return setup;
}

/// The least that tasks took, and their taking, where workers come one after the other on the caller's
/// thread.
class TaskCosts {
 public:
  TaskCosts(const WorkloadEntry& entry, const WorkloadSetup& setup, int workers)
      : workers_(std::make_shared<WorkersOnCaller>(workers)),
        workload_(entry, with_workers(setup, workers_)) {}

  void draw(bool counts) {
    workers_->take_seconds(), workers_->take_calls();
    TracedFrame frame = workload_.draw();
    frame.seconds_taking = workers_->take_seconds() - frame.seconds_in_tasks();
    frame.calls_without_tasks = workers_->take_calls() - passes_of(frame.tasks);
    const bool has_no_trace =
        frame.tasks.empty() && least_ && !least_->tasks.empty();  // there was no memory for it
    if (!counts || has_no_trace) return;
    if (!least_ || least_->tasks.size() != frame.tasks.size())
      least_ = frame;  // bins that grew need fewer passes
    least_->seconds_taking = std::min(least_->seconds_taking, frame.seconds_taking);
    for (std::size_t i = 0; i < frame.tasks.size(); ++i)
      if (length(frame.tasks[i]) < length(least_->tasks[i])) least_->tasks[i] = frame.tasks[i];
    least_->seconds = least_->seconds_taking + least_->seconds_in_tasks();
  }
  /// @pre one counted
  const TracedFrame& least() const { return *least_; }

 private:
  std::shared_ptr<WorkersOnCaller> workers_;
  TracedWorkload workload_;
  std::optional<TracedFrame> least_;
};

/// The least of the seconds of a frame in which no worker runs.
class RestCosts {
 public:
  RestCosts(const WorkloadEntry& entry, const WorkloadSetup& setup, std::shared_ptr<PretendedWorkers> workers)
      : workers_(std::move(workers)), workload_(entry.make(with_workers(setup, workers_))) {}

  void draw(bool counts) {
    workers_->take_seconds();
    const Clock::time_point start = Clock::now();
    workload_->draw();
    const double rest = seconds_since(start) - workers_->take_seconds();
    if (counts) least_ = std::min(least_, rest);
  }
  double least() const { return least_; }

 private:
  std::shared_ptr<PretendedWorkers> workers_;
  std::unique_ptr<Workload> workload_;
  double least_ = std::numeric_limits<double>::infinity();
};

/// Of a frame whose work is cut for so many workers.
class FrameCosts {
 public:
  /// @param cores  the first is the caller's
  FrameCosts(const WorkloadEntry& entry, const WorkloadSetup& setup, int workers,
             const std::vector<int>& cores)
      : tasks_(entry, setup, workers) {
    tasks_.draw(false);  // may draw more than a frame
    tasks_.draw(true);   // tells what the rest needs to know
    rest_.emplace(entry, setup, workers_for_rest(workers, cores));
  }

  void take_turn() {
    for (int i = 0; i <= kFramesOfATurn; ++i)
      tasks_.draw(i > 0);  // after the first one caches are its own again
    for (int i = 0; i <= kFramesOfATurn; ++i) rest_->draw(i > 0);
  }
  TracedFrame least() const {
    TracedFrame frame = tasks_.least();
    frame.seconds += rest_->least();
    return frame;
  }

 private:
  std::shared_ptr<PretendedWorkers> workers_for_rest(int workers, const std::vector<int>& cores) const {
    if (workers == 1 || cores.size() < 2) return std::make_shared<WorkersOnCaller>(workers);
    const TracedFrame& frame = tasks_.least();
    const auto passes =
        static_cast<std::size_t>(std::max(1, passes_of(frame.tasks) + frame.calls_without_tasks));
    return std::make_shared<WorkersElsewhere>(workers, cores.back(),
                                              frame.work.bytes / passes / static_cast<std::size_t>(workers));
  }

  TaskCosts tasks_;
  std::optional<RestCosts> rest_;
};

}  // namespace

TracedFrame cost_of_tasks(const WorkloadEntry& entry, const WorkloadSetup& setup, int workers) {
  TaskCosts costs(entry, setup, workers);
  for (int i = 0; i < kWarmUps + kFrames; ++i) costs.draw(i >= kWarmUps);
  return costs.least();
}

std::vector<TracedFrame> costs_of_frames(const WorkloadEntry& entry, const WorkloadSetup& setup,
                                         std::span<const int> workers, double seconds) {
  return std::async(std::launch::async,
                    [&] {
                      const std::vector<int> cores = allowed_cores();
                      if (cores.size() > 1) keep_on({&cores.front(), 1});
                      std::vector<std::unique_ptr<FrameCosts>> all;
                      for (const int count : workers)
                        all.push_back(std::make_unique<FrameCosts>(entry, setup, count, cores));
                      const Clock::time_point start = Clock::now();
                      for (int turn = 0; turn < kFewestTurns || seconds_since(start) < seconds; ++turn)
                        for (const auto& costs : all) costs->take_turn();
                      std::vector<TracedFrame> least;
                      for (const auto& costs : all) least.push_back(costs->least());
                      return least;
                    })
      .get();
}

}  // namespace tessera::bench
