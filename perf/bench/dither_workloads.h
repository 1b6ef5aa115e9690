// Costs of dithers: the built-in scene in RGB of 16 bits and in 256 colours.
#pragma once

#include <vector>

#include "perf/bench/workload.h"

namespace tessera::bench {

std::vector<WorkloadEntry> dither_workloads();

}  // namespace tessera::bench
