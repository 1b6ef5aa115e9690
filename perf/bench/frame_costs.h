// What a frame's work costs task by task, as if it were cut for many workers: what computed machines do it
// with.
#pragma once

#include <span>
#include <vector>

#include "perf/bench/traced_frame.h"

namespace tessera::bench {

/// What the work costs, cut for so many workers, when one thread does all of it: of each task and of the
/// taking of all the least of several frames. (Their taking has them noted, too.)
TracedFrame measure_task_costs(const WorkloadEntry& entry, const WorkloadSetup& setup, int workers);
/// For each count of workers, also of what is in no worker's time: the least of several frames that are not
/// traced, for handing tasks over takes longer than much of it. Of several workers' frames it is measured
/// with their tasks on another core than the caller's, where there are two that threads can be kept on, while
/// the caller reads as many bytes as a worker's share of what the frame moves. All of them take turns, so
/// that a clock that changes meanwhile is all of theirs.
/// @param seconds  that turns go on for, if there were enough of them
std::vector<TracedFrame> measure_frame_costs(const WorkloadEntry& entry, const WorkloadSetup& setup,
                                             std::span<const int> workers, double seconds);

}  // namespace tessera::bench
