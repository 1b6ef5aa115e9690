#include "perf/bench/traced_frame.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>
#include <set>
#include <utility>

#include <nlohmann/json.hpp>

namespace tessera::bench {
namespace {

constexpr int kWarmUps = 3;
constexpr int kFrames = 9;

const char* name_of(FrameStage stage) {
  switch (stage) {
    case FrameStage::vertices: return "vertices";
    case FrameStage::flat_colors: return "flat_colors";
    case FrameStage::binning: return "binning";
    default: return "tiles";
  }
}

nlohmann::ordered_json event_of(const FrameTask& task, std::size_t process) {
  nlohmann::ordered_json event{
      {"name", name_of(task.stage)},          {"ph", "X"},      {"ts", task.begin * 1e6},
      {"dur", (task.end - task.begin) * 1e6}, {"pid", process}, {"tid", task.worker},
      {"args", {{"pass", task.pass}}}};
  if (task.pixels.width > 0)
    event["args"].update({{"x", task.pixels.x},
                          {"y", task.pixels.y},
                          {"width", task.pixels.width},
                          {"height", task.pixels.height}});
  return event;
}

double ns_per_pixel(const FrameTask& task) {
  return 1e9 * (task.end - task.begin) / (static_cast<double>(task.pixels.width) * task.pixels.height);
}

using Clock = std::chrono::steady_clock;

std::set<int> workers_of(std::span<const FrameTask> tasks) {
  std::set<int> workers;
  for (const FrameTask& task : tasks) workers.insert(task.worker);
  return workers;
}

}  // namespace

double TracedFrame::task_seconds() const {
  return std::accumulate(tasks.begin(), tasks.end(), 0.0,
                         [](double sum, const FrameTask& task) { return sum + task.end - task.begin; });
}

TracedWorkload::TracedWorkload(const WorkloadEntry& entry, WorkloadSetup setup) : name_(entry.name) {
  setup.options.trace = [this](std::span<const FrameTask> tasks) {
    tasks_.assign(tasks.begin(), tasks.end());
  };
  workload_ = entry.make(setup);
}

TracedFrame TracedWorkload::draw() {
  const Clock::time_point start = Clock::now();
  const FrameStats stats = workload_->draw();
  const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
  return {.workload = name_, .seconds = seconds, .tasks = tasks_, .work = workload_->work(stats)};
}

TracedFrame trace_frame(const WorkloadEntry& entry, const WorkloadSetup& setup) {
  TracedWorkload workload(entry, setup);
  std::vector<TracedFrame> frames;
  for (int i = 0; i < kWarmUps + kFrames; ++i) {
    TracedFrame frame = workload.draw();
    if (i >= kWarmUps) frames.push_back(std::move(frame));
  }
  std::nth_element(frames.begin(), frames.begin() + kFrames / 2, frames.end(),
                   [](const TracedFrame& a, const TracedFrame& b) { return a.seconds < b.seconds; });
  return frames[kFrames / 2];
}

std::string chrome_trace(const std::vector<TracedFrame>& frames) {
  nlohmann::ordered_json events = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < frames.size(); ++i) {
    events.push_back(
        {{"name", "process_name"}, {"ph", "M"}, {"pid", i}, {"args", {{"name", frames[i].workload}}}});
    for (const int worker : workers_of(frames[i].tasks))
      events.push_back({{"name", "thread_name"},
                        {"ph", "M"},
                        {"pid", i},
                        {"tid", worker},
                        {"args", {{"name", "worker " + std::to_string(worker)}}}});
    for (const FrameTask& task : frames[i].tasks) events.push_back(event_of(task, i));
  }
  return nlohmann::ordered_json{{"traceEvents", std::move(events)}, {"displayTimeUnit", "ms"}}.dump() + "\n";
}

void paint_cost(std::uint8_t* rgba, double share) {
  for (int c = 0; c < 3; ++c)
    rgba[c] = static_cast<std::uint8_t>(std::lround(255 * std::clamp(3 * share - c, 0.0, 1.0)));
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
    if (task.stage == FrameStage::tiles) {
      map.max_ns_per_pixel = std::max(map.max_ns_per_pixel, ns_per_pixel(task));
      map.tiles_ms += 1e3 * (task.end - task.begin);
    }
  for (const FrameTask& task : frame.tasks)
    for (int y = task.pixels.y; y < task.pixels.y + task.pixels.height; ++y)
      for (int x = task.pixels.x; x < task.pixels.x + task.pixels.width; ++x)
        paint_cost(map.picture.rgba.data() +
                       4 * (static_cast<std::size_t>(height - 1 - y) * static_cast<std::size_t>(width) +
                            static_cast<std::size_t>(x)),
                   ns_per_pixel(task) / map.max_ns_per_pixel);
  return map;
}

}  // namespace tessera::bench
