#include "perf/bench/traced_frame.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <future>
#include <limits>
#include <memory>
#include <numeric>
#include <set>
#include <utility>

#include <nlohmann/json.hpp>

#include "perf/bench/pretended_workers.h"

namespace tessera::bench {
namespace {

constexpr int kWarmUps = 3, kFrames = 9;

const char* name_of(FrameStage stage) {
  switch (stage) {
    case FrameStage::vertices: return "vertices";
    case FrameStage::faces: return "faces";
    case FrameStage::binning: return "binning";
    default: return "tiles";
  }
}

nlohmann::ordered_json event_of(const FrameTask& task, std::size_t process) {
  nlohmann::ordered_json event{{"name", name_of(task.stage)}, {"ph", "X"}, {"ts", task.begin * 1e6}, {"dur", (task.end - task.begin) * 1e6}, {"pid", process}, {"tid", task.worker}, {"args", {{"pass", task.pass}}}};
  if (task.pixels.width > 0) event["args"].update({{"x", task.pixels.x}, {"y", task.pixels.y}, {"width", task.pixels.width}, {"height", task.pixels.height}});
  return event;
}

double ns_a_pixel(const FrameTask& task) { return 1e9 * (task.end - task.begin) / (static_cast<double>(task.pixels.width) * task.pixels.height); }

// Red rises first, then green, then blue.
void paint(std::uint8_t* rgba, double share) {
  for (int c = 0; c < 3; ++c) rgba[c] = static_cast<std::uint8_t>(std::lround(255 * std::clamp(3 * share - c, 0.0, 1.0)));
}

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

int passes_of(std::span<const FrameTask> tasks) {
  std::set<int> passes;
  for (const FrameTask& task : tasks) passes.insert(task.pass);
  return static_cast<int>(passes.size());
}

std::set<int> workers_of(std::span<const FrameTask> tasks) {
  std::set<int> workers;
  for (const FrameTask& task : tasks) workers.insert(task.worker);
  return workers;
}

/// @param workers  null, or the executor of `setup`
std::vector<TracedFrame> frames_of(const WorkloadEntry& entry, const WorkloadSetup& setup, PretendedWorkers* workers = nullptr) {
  WorkloadSetup traced = setup;
  std::vector<FrameTask> tasks;
  traced.options.trace = [&tasks](std::span<const FrameTask> of_frame) { tasks.assign(of_frame.begin(), of_frame.end()); };
  const std::unique_ptr<Workload> workload = entry.make(traced);
  std::vector<TracedFrame> frames;
  for (int i = 0; i < kWarmUps + kFrames; ++i) {
    if (workers != nullptr) workers->take_seconds(), workers->take_calls();
    const Clock::time_point start = Clock::now();
    const FrameStats stats = workload->draw();
    TracedFrame frame{.workload = entry.name, .seconds = seconds_since(start), .tasks = tasks, .work = workload->work(stats)};
    if (workers != nullptr) {
      frame.seconds_taking = workers->take_seconds() - frame.seconds_in_tasks();
      frame.calls_without_tasks = workers->take_calls() - passes_of(frame.tasks);
    }
    if (i >= kWarmUps) frames.push_back(std::move(frame));
  }
  return frames;
}

double length(const FrameTask& task) { return task.end - task.begin; }

WorkloadSetup with_workers(WorkloadSetup setup, const std::shared_ptr<PretendedWorkers>& workers) {
  setup.options.threads = workers->workers();
  setup.options.executor = workers;
  return setup;
}

}  // namespace

double TracedFrame::seconds_in_tasks() const {
  return std::accumulate(tasks.begin(), tasks.end(), 0.0, [](double sum, const FrameTask& task) { return sum + length(task); });
}

TracedFrame trace_frame(const WorkloadEntry& entry, const WorkloadSetup& setup) {
  std::vector<TracedFrame> frames = frames_of(entry, setup);
  std::nth_element(frames.begin(), frames.begin() + kFrames / 2, frames.end(), [](const TracedFrame& a, const TracedFrame& b) { return a.seconds < b.seconds; });
  return frames[kFrames / 2];
}

TracedFrame cost_of_tasks(const WorkloadEntry& entry, const WorkloadSetup& setup, int workers) {
  const auto on_caller = std::make_shared<WorkersOnCaller>(workers);
  const std::vector<TracedFrame> frames = frames_of(entry, with_workers(setup, on_caller), on_caller.get());
  TracedFrame least = frames.front();
  for (const TracedFrame& frame : frames) {
    least.seconds_taking = std::min(least.seconds_taking, frame.seconds_taking);
    for (std::size_t i = 0; i < least.tasks.size(); ++i)
      if (length(frame.tasks[i]) < length(least.tasks[i])) least.tasks[i] = frame.tasks[i];
  }
  least.seconds = least.seconds_taking + least.seconds_in_tasks();
  return least;
}

namespace {

/// Seconds of a frame in which no worker runs: the least of several frames.
double seconds_alone(const WorkloadEntry& entry, const WorkloadSetup& setup, const std::shared_ptr<PretendedWorkers>& pretended) {
  const std::unique_ptr<Workload> workload = entry.make(with_workers(setup, pretended));
  double least_rest = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kWarmUps + kFrames; ++i) {
    pretended->take_seconds();
    const Clock::time_point start = Clock::now();
    workload->draw();
    const double rest = seconds_since(start) - pretended->take_seconds();
    if (i >= kWarmUps) least_rest = std::min(least_rest, rest);
  }
  return least_rest;
}

}  // namespace

TracedFrame cost_of_frame(const WorkloadEntry& entry, const WorkloadSetup& setup, int workers) {
  TracedFrame cost = cost_of_tasks(entry, setup, workers);
  const std::vector<int> cores = allowed_cores();
  if (workers == 1 || cores.size() < 2) {
    cost.seconds += seconds_alone(entry, setup, std::make_shared<WorkersOnCaller>(workers));
    return cost;
  }
  const auto passes = static_cast<std::size_t>(std::max(1, passes_of(cost.tasks) + cost.calls_without_tasks));
  const std::size_t share_bytes = cost.work.bytes / passes / static_cast<std::size_t>(workers);
  cost.seconds += std::async(std::launch::async, [&] {
                    keep_on({&cores.front(), 1});
                    return seconds_alone(entry, setup, std::make_shared<WorkersElsewhere>(workers, cores.back(), share_bytes));
                  }).get();
  return cost;
}

std::string chrome_trace(const std::vector<TracedFrame>& frames) {
  nlohmann::ordered_json events = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < frames.size(); ++i) {
    events.push_back({{"name", "process_name"}, {"ph", "M"}, {"pid", i}, {"args", {{"name", frames[i].workload}}}});
    for (const int worker : workers_of(frames[i].tasks))
      events.push_back({{"name", "thread_name"}, {"ph", "M"}, {"pid", i}, {"tid", worker}, {"args", {{"name", "worker " + std::to_string(worker)}}}});
    for (const FrameTask& task : frames[i].tasks) events.push_back(event_of(task, i));
  }
  return nlohmann::ordered_json{{"traceEvents", std::move(events)}, {"displayTimeUnit", "ms"}}.dump() + "\n";
}

Heatmap heatmap(const TracedFrame& frame) {
  int width = 0, height = 0;
  for (const FrameTask& task : frame.tasks) {
    width = std::max(width, task.pixels.x + task.pixels.width);
    height = std::max(height, task.pixels.y + task.pixels.height);
  }
  Heatmap map{.picture = Picture(width, height)};
  for (std::size_t i = 3; i < map.picture.rgba.size(); i += 4) map.picture.rgba[i] = 255;
  for (const FrameTask& task : frame.tasks)
    if (task.stage == FrameStage::tiles) map.most_ns_a_pixel = std::max(map.most_ns_a_pixel, ns_a_pixel(task));
  for (const FrameTask& task : frame.tasks)
    for (int y = task.pixels.y; y < task.pixels.y + task.pixels.height; ++y)
      for (int x = task.pixels.x; x < task.pixels.x + task.pixels.width; ++x)
        paint(map.picture.rgba.data() + 4 * (static_cast<std::size_t>(height - 1 - y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)), ns_a_pixel(task) / map.most_ns_a_pixel);
  return map;
}

}  // namespace tessera::bench
