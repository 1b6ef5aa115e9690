// Workloads that measure the cost of single fragment operations.
#pragma once

#include <vector>

#include "perf/bench/workload.h"

namespace tessera::bench {

/// "operation-none" draws the lit teapot of the built-in scene; each "operation-<name>" adds one operation,
/// and has "operation-none" as its baseline.
std::vector<WorkloadEntry> operation_workloads();

}  // namespace tessera::bench
