// User stages, compared with the same work without a stage.
#include "perf/bench/mesh_workloads.h"

namespace tessera::bench {

std::vector<WorkloadEntry> stage_workloads() {
  return {phong_with_stage(), fill_with_stage(), grid_with_stage()};
}

}  // namespace tessera::bench
