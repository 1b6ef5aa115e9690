// Thread affinity and core-to-core latency.
#pragma once

#include <span>
#include <vector>

namespace tessera::bench {

/// Logical CPU numbers that the calling thread may run on, in ascending order. Two of them may be hardware
/// threads of one core.
std::vector<int> allowed_cores();
/// Restricts the calling thread, and threads that it starts later, to these CPUs.
/// Returns false if the system refuses.
bool set_thread_affinity(std::span<const int> cores);

/// Latency in nanoseconds of passing a modified cache line between the first two allowed cores: minimum of
/// several runs, 0 if only one core is allowed. Tens with a shared cache, hundreds without. In a virtual
/// machine it may change over time.
double core_to_core_ns();

}  // namespace tessera::bench
