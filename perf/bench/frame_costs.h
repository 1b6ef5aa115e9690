// Cost of a frame's work per task, split as for many workers: the input of the model of many cores.
#pragma once

#include <span>
#include <vector>

#include "perf/bench/traced_frame.h"

namespace tessera::bench {

/// Cost of the tasks of a frame that is split for `workers` workers, run on one thread. Each task, and the
/// dispatch of all of them, gets its minimum over several frames. (Dispatch includes recording the trace.)
TracedFrame measure_task_costs(const WorkloadEntry& entry, const WorkloadSetup& setup, int workers);

/// Frame time for each worker count, with the serial time of the frame added: the minimum over several
/// untraced frames, because recording tasks would take longer than much of it.
/// - With several workers, the serial time is measured while the tasks run on a core other than the caller's,
///   if there are two cores that threads can be bound to. Meanwhile the caller reads as many bytes as one
///   worker's share of the frame's traffic.
/// - All counts take turns, so that a changing clock affects all of them.
/// @param seconds  minimum duration of the turns
std::vector<TracedFrame> measure_frame_costs(const WorkloadEntry& entry, const WorkloadSetup& setup,
                                             std::span<const int> workers, double seconds);

}  // namespace tessera::bench
