// The workloads that the command line selects.
#pragma once

#include <string>
#include <vector>

#include "perf/bench/workload.h"

namespace tessera::bench {

struct Selection {
  std::vector<const WorkloadEntry*> entries;  ///< workloads that can run
  std::string skipped;                        ///< one line for each of the others, with the reason
};
/// Selects workloads by name or prefix, in table order, and prepares them.
/// @param names  empty: all workloads
/// @throws CLI::ValidationError if a name selects no workload
/// @throws Error if none of the workloads that a name selects can run
Selection prepare_workloads(const std::vector<std::string>& names);

}  // namespace tessera::bench
