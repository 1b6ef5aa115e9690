// How fast this machine moves bytes: what fills, clears and plane stores are held against.
#pragma once

#include <cstdint>

#include "perf/bench/workload.h"

namespace tessera::bench {

/// In 10^9 bytes a second, of all threads together: the median of several runs.
///
/// @param limit  not none
/// @param bytes  that a frame moves
double measure_limit(Limit limit, int threads, std::uint64_t bytes);

}  // namespace tessera::bench
