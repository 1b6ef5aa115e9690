// Workloads that draw models from Debian packages.
#pragma once

#include <vector>

#include "perf/bench/workload.h"

namespace tessera::bench {

std::vector<WorkloadEntry> model_workloads();

}  // namespace tessera::bench
