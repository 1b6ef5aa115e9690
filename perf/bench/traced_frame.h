// One frame of a workload, task by task.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "perf/bench/workload.h"

namespace tessera::bench {

struct TracedFrame {
  std::string workload;
  double seconds = 0;              ///< from its first command to its end; of costs their sum
  std::vector<FrameTask> tasks{};  ///< in the order in which they began
  double dispatch_seconds = 0;     ///< where workers run, but not at tasks: they take their next ones, or do
                                   ///< what no task tells of; of costs only
  int untraced_calls = 0;          ///< for workers, who run in them all the same; of costs only
  FrameWork work{};

  double task_seconds() const;  ///< of all workers together
};

/// A workload whose frames tell of their tasks.
class TracedWorkload {
 public:
  TracedWorkload(const WorkloadEntry& entry, WorkloadSetup setup);
  TracedWorkload(const TracedWorkload&) = delete;
  TracedWorkload& operator=(const TracedWorkload&) = delete;

  TracedFrame draw();

 private:
  std::string name_;
  std::vector<FrameTask> tasks_{};  // of the last frame
  std::unique_ptr<Workload> workload_{};
};

/// Of several frames after the first ones the one in the middle, by time.
TracedFrame trace_frame(const WorkloadEntry& entry, const WorkloadSetup& setup);

/// As Chrome's trace viewer (chrome://tracing, ui.perfetto.dev) shows it: workloads are its processes,
/// workers its threads. Source: Trace Event Format, complete events ("X"), times in microseconds.
std::string chrome_trace(const std::vector<TracedFrame>& frames);

/// What pixels of a frame cost, tile by tile: from black over red and yellow to white, which is what the
/// dearest tile costs.
struct Heatmap {
  Picture picture;
  double max_ns_per_pixel = 0;  ///< white
};
Heatmap heatmap(const TracedFrame& frame);

}  // namespace tessera::bench
