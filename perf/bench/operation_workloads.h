// Workloads that measure the cost of single fragment operations.
#pragma once

#include <vector>

#include "perf/bench/workload.h"

namespace tessera::bench {

/// "operation-none", the lit teapot of the built-in scene, and "operation-<name>", the same with one
/// operation added. All but the first have "operation-none" as their baseline.
std::vector<WorkloadEntry> operation_workloads();

}  // namespace tessera::bench
