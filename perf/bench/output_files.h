// Checks of output files before anything is measured.
#pragma once

#include "perf/bench/bench_options.h"

namespace tessera::bench {

/// Checks that all outputs can be written, as far as that can be known, and are different files.
/// "-" is the standard output.
/// @throws CLI::ValidationError if two options name the same file
/// @throws Error if a file cannot be written
void require_outputs(const BenchOptions& options);

}  // namespace tessera::bench
