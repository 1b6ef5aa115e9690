// Cost of a frame's work per task, split as for many workers: the input of the model of many cores.
#pragma once

#include <span>
#include <vector>

#include "perf/bench/traced_frame.h"

namespace tessera::bench {

/// Cost of the tasks of a frame that is split for `workers` workers, run on one thread.
/// - Each task has its minimum time over several frames, and so has the dispatch of all tasks.
/// - Dispatch includes recording the trace.
TracedFrame measure_task_costs(const WorkloadEntry& entry, const WorkloadSetup& setup, int workers);

/// For each worker count: the costs that measure_task_costs() returns, plus the serial time of the frame.
/// - Serial time is the minimum over several frames without a trace: recording it would take longer than much
///   of the serial work.
/// - With several workers, the tasks run on a core other than the caller's while serial time is measured, if
///   there are two cores that threads can be bound to. Meanwhile the caller reads as many bytes as one
///   worker's share of the frame's traffic.
/// - All worker counts take turns, so that a changing clock affects all of them.
/// @param seconds  minimum duration of the turns
std::vector<TracedFrame> measure_frame_costs(const WorkloadEntry& entry, const WorkloadSetup& setup,
                                             std::span<const int> workers, double seconds);

}  // namespace tessera::bench
