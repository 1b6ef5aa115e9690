#include <algorithm>

#include "perf/bench/dither_workloads.h"
#include "perf/bench/elision_workloads.h"
#include "perf/bench/fill_workloads.h"
#include "perf/bench/mesh_workloads.h"
#include "perf/bench/model_workloads.h"
#include "perf/bench/operation_workloads.h"
#include "perf/bench/workload.h"

namespace tessera::bench {

const std::vector<WorkloadEntry>& workloads() {
  static const std::vector<WorkloadEntry> kAll = [] {
    std::vector<WorkloadEntry> all;
    for (auto* const list :
         {fill_workloads, grid_workloads, lit_workloads, point_and_line_workloads, model_workloads,
          scene_workloads, object_workloads, stage_workloads, operation_workloads, elision_workloads,
          frame_buffer_workloads, dither_workloads, plane_store_workloads, palette_workloads}) {
      std::vector<WorkloadEntry> entries = list();
      all.insert(all.end(), entries.begin(), entries.end());
    }
    return all;
  }();
  return kAll;
}

const WorkloadEntry* find_workload(std::string_view name) {
  const std::vector<WorkloadEntry>& all = workloads();
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const WorkloadEntry& entry) { return entry.name == name; });
  return found == all.end() ? nullptr : &*found;
}

}  // namespace tessera::bench
