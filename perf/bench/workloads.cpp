#include "perf/bench/fill_workloads.h"
#include "perf/bench/mesh_workloads.h"
#include "perf/bench/model_workloads.h"
#include "perf/bench/workload.h"

namespace tessera::bench {

const std::vector<WorkloadEntry>& workloads() {
  static const std::vector<WorkloadEntry> kAll = [] {
    std::vector<WorkloadEntry> all;
    for (auto* const list :
         {fill_workloads, grid_workloads, lit_workloads, point_and_line_workloads, model_workloads,
          scene_workloads, frame_buffer_workloads, plane_store_workloads}) {
      std::vector<WorkloadEntry> some = list();
      all.insert(all.end(), some.begin(), some.end());
    }
    return all;
  }();
  return kAll;
}

}  // namespace tessera::bench
