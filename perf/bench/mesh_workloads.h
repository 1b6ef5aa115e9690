// Workloads of many triangles, points and lines, and of lit ones; of the frame buffer; of whole scenes.
#pragma once

#include <vector>

#include "perf/bench/workload.h"

namespace tessera::bench {

std::vector<WorkloadEntry> grid_workloads();
std::vector<WorkloadEntry> lit_workloads();
std::vector<WorkloadEntry> point_and_line_workloads();
std::vector<WorkloadEntry> frame_buffer_workloads();
std::vector<WorkloadEntry> plane_store_workloads();
std::vector<WorkloadEntry> scene_workloads();

// Those that grow by one number.
WorkloadEntry grid_of(int side);  ///< 2 side^2 triangles over the whole window
WorkloadEntry sphere_in_frame(int width, int height);
WorkloadEntry sphere_with_lights(int lights);        ///< lit at its pixels
WorkloadEntry patches_in_separate_draws(int draws);  ///< of 32 triangles each

}  // namespace tessera::bench
