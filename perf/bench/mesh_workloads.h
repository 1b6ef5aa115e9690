// Workloads with many triangles, points and lines; with lighting; of the frame buffer; and of whole scenes.
#pragma once

#include <vector>

#include "perf/bench/workload.h"

namespace tessera::bench {

std::vector<WorkloadEntry> grid_workloads();
std::vector<WorkloadEntry> lit_workloads();
std::vector<WorkloadEntry> point_and_line_workloads();
std::vector<WorkloadEntry> frame_buffer_workloads();
std::vector<WorkloadEntry> plane_store_workloads();
std::vector<WorkloadEntry> palette_workloads();
std::vector<WorkloadEntry> scene_workloads();
std::vector<WorkloadEntry> object_workloads();
std::vector<WorkloadEntry> stage_workloads();

// Workloads that scale with one parameter, for --growth.
WorkloadEntry grid_of(int side);  ///< 2 * side^2 triangles over the whole window
WorkloadEntry sphere_in_frame(int width, int height);
WorkloadEntry sphere_with_lights(int lights);        ///< per-pixel lighting
WorkloadEntry patches_in_separate_draws(int draws);  ///< 32 triangles per draw

// Workloads with a user stage that passes values through; their baselines have none.
WorkloadEntry phong_with_stage();  ///< per-pixel lighting by 8 lights, fragment stage
WorkloadEntry fill_with_stage();   ///< 16 layers of interpolated colours, fragment stage
WorkloadEntry grid_with_stage();   ///< 2 M triangles, vertex stage

}  // namespace tessera::bench
