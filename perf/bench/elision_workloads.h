// Workloads that measure what leaving out an unnecessary effect saves (RendererOptions::elide).
#pragma once

#include <vector>

#include "perf/bench/workload.h"

namespace tessera::bench {

/// "elision-<name>" draws a scene in which an effect cannot matter; "elision-<name>-in-full" runs the effect
/// all the same, and has "elision-<name>" as its baseline: their ratio is the speed-up.
std::vector<WorkloadEntry> elision_workloads();

}  // namespace tessera::bench
