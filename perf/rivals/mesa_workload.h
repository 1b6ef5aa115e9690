// A workload as Mesa draws it, through OSMesa.
#pragma once

#include <memory>
#include <string>

#include "perf/bench/gl_workload.h"
#include "perf/bench/workload.h"

namespace tessera::rivals {

/// What of Mesa draws: its compiler of shaders on 2 threads or more, or its interpreter.
enum class MesaDriver { llvmpipe, softpipe };

/// @param threads  what llvmpipe may use; Mesa reads it, and the driver, when its first context is made: the
/// same for all of a process.
///     With one it draws on the thread that calls it.
/// @throws std::runtime_error where OSMesa is missing, has another driver, or does not take a shader
std::unique_ptr<bench::Workload> mesa_workload(const bench::GlWorkload& form, int width, int height,
                                               MesaDriver driver, int threads);

/// Time in ms, the median of many, of a frame that changes one pixel: what finishing a frame costs by itself.
/// What that is more than in a window of one pixel is a copy of the picture.
double mesa_finish_ms(int width, int height, MesaDriver driver, int threads);

/// The driver's own name for itself, with its version. @throws as mesa_workload
std::string mesa_name(MesaDriver driver, int threads);

}  // namespace tessera::rivals
