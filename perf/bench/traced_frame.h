// One frame of a workload, task by task.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "perf/bench/workload.h"

namespace tessera::bench {

struct TracedFrame {
  std::string workload;
  /// From the first command to the end of finish(); in frames of measure_task_costs() and
  /// measure_frame_costs(), the sum of all parts.
  double seconds = 0;
  std::vector<FrameTask> tasks{};  ///< in the order in which they began
  /// Time in which workers run outside tasks: they take their next task or do untraced work.
  /// Set by measure_task_costs() and measure_frame_costs() only.
  double dispatch_seconds = 0;
  /// Executor calls that no task belongs to. Set by the same functions only.
  int untraced_calls = 0;
  FrameWork work{};

  double task_seconds() const;  ///< sum over all workers
};

/// A workload whose frames report their tasks.
class TracedWorkload {
 public:
  TracedWorkload(const WorkloadEntry& entry, WorkloadSetup setup);
  TracedWorkload(const TracedWorkload&) = delete;
  TracedWorkload& operator=(const TracedWorkload&) = delete;

  TracedFrame draw();

 private:
  std::string name_;
  std::vector<FrameTask> tasks_{};  // tasks of the last frame
  std::unique_ptr<Workload> workload_{};
};

/// The frame of median duration among several frames after a warm-up.
TracedFrame trace_frame(const WorkloadEntry& entry, const WorkloadSetup& setup);

/// JSON for Chrome's trace viewer (chrome://tracing, ui.perfetto.dev): one process per workload, one thread
/// per worker. Source: Trace Event Format, complete events ("X"), times in microseconds.
std::string chrome_trace(const std::vector<TracedFrame>& frames);

/// Sets red, green and blue for a share of the maximum from 0 to 1: black, red, yellow, white.
void paint_cost(std::uint8_t* rgba, double share);

/// Cost per pixel of each tile, from black through red and yellow to white, the most expensive tile.
struct Heatmap {
  Picture picture;
  double max_ns_per_pixel = 0;  ///< nanoseconds of one thread; shown as white
  double tiles_ms = 0;          ///< milliseconds of one thread for all tiles
};
/// The picture is empty if the frame has no tile tasks.
Heatmap heatmap(const TracedFrame& frame);

}  // namespace tessera::bench
