// Workloads that cover the whole window.
#pragma once

#include <vector>

#include "perf/bench/workload.h"

namespace tessera::bench {

std::vector<WorkloadEntry> fill_workloads();

}  // namespace tessera::bench
