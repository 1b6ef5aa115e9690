// One frame of a workload, task by task.
#pragma once

#include <string>
#include <vector>

#include "perf/bench/workload.h"

namespace tessera::bench {

struct TracedFrame {
  std::string workload;
  double seconds = 0;               ///< from its first command to its end; of costs their sum
  std::vector<FrameTask> tasks{};   ///< in the order in which they began
  double seconds_taking = 0;        ///< where workers run, but not at tasks: they take their next ones, or do what no task tells of; where cost_of_tasks() measured it
  int calls_without_tasks = 0;      ///< for workers, who run in them all the same; where cost_of_tasks() counted them
  FrameWork work{};

  double seconds_in_tasks() const;  ///< of all workers together
};

/// Of several frames after the first ones the one in the middle, by time.
TracedFrame trace_frame(const WorkloadEntry& entry, const WorkloadSetup& setup);
/// What the work costs, cut for so many workers, when one thread does all of it: of each task and of the taking of all the least of several frames. (Their
/// taking has them noted, too.)
TracedFrame cost_of_tasks(const WorkloadEntry& entry, const WorkloadSetup& setup, int workers);
/// Also of what is in no worker's time: the least of several frames that are not traced, for handing tasks over takes longer than much of it. Of several workers'
/// frames it is measured with their tasks on another core than the caller's, where there are two that threads can be kept on, while the caller reads as many bytes
/// as a worker's share of what the frame moves.
TracedFrame cost_of_frame(const WorkloadEntry& entry, const WorkloadSetup& setup, int workers);

/// As Chrome's trace viewer (chrome://tracing, ui.perfetto.dev) shows it: workloads are its processes, workers its threads.
/// Source: Trace Event Format, complete events ("X"), times in microseconds.
std::string chrome_trace(const std::vector<TracedFrame>& frames);

/// What pixels of a frame cost, tile by tile: from black over red and yellow to white, which is what the dearest tile costs.
struct Heatmap {
  Picture picture;
  double most_ns_a_pixel = 0;       ///< white
};
Heatmap heatmap(const TracedFrame& frame);

}  // namespace tessera::bench
