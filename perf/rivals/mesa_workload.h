// Workloads drawn by Mesa through OSMesa.
#pragma once

#include <memory>
#include <string>

#include "perf/bench/gl_workload.h"
#include "perf/bench/workload.h"

namespace tessera::rivals {

/// llvmpipe compiles shaders and uses several threads; softpipe interprets them.
enum class MesaDriver { llvmpipe, softpipe };

/// Mesa reads the driver and the thread count when it makes the first context of a process: they must be the
/// same in all calls.
/// @param threads  number of threads that llvmpipe may use; with 1 it draws on the calling thread
/// @throws std::runtime_error if OSMesa is missing, has another driver, or rejects a shader
std::unique_ptr<bench::Workload> mesa_workload(const bench::GlWorkload& workload, int width, int height,
                                               MesaDriver driver, int threads);

/// Median time in ms of a frame that changes one pixel: the fixed cost of finishing a frame.
/// The copy of the picture is the part by which it exceeds that of a window of one pixel.
double mesa_finish_ms(int width, int height, MesaDriver driver, int threads);

/// Name and version that the driver reports.
/// @throws std::runtime_error as mesa_workload() does
std::string mesa_name(MesaDriver driver, int threads);

}  // namespace tessera::rivals
