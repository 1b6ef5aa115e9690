// Workloads that measure what leaving out an unnecessary effect saves (RendererOptions::elide).
#pragma once

#include <vector>

#include "perf/bench/workload.h"

namespace tessera::bench {

/// "elision-<name>" draws a scene in which an effect cannot matter; "elision-<name>-in-full" runs the effect
/// all the same, and has "elision-<name>" as its baseline: their ratio is the speed-up.
/// "elision-64-lights-<name>" has 60 lights that reach nothing, and "elision-4-lights-<name>", the other four
/// alone, as its baseline: their ratio is the cost of the useless ones.
std::vector<WorkloadEntry> elision_workloads();

}  // namespace tessera::bench
