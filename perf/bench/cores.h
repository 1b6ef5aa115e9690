// The cores that threads are kept on, and how far from each other they are.
#pragma once

#include <span>
#include <vector>

namespace tessera::bench {

/// Numbers of those that the calling thread may use, as the system counts them: two of them may be threads of
/// one core.
std::vector<int> allowed_cores();
/// Keeps the calling thread, and threads that it starts from now on, on these. False if the system does not
/// let it.
bool set_thread_affinity(std::span<const int> cores);

/// Nanoseconds in which a cache line that one core has written reaches another one that waits for it, between
/// the first two of the calling thread's: the least of several runs; 0 where there is but one. Tens where
/// they share a cache, hundreds where they do not. A virtual machine's cores may do now this, now that.
double core_to_core_ns();

}  // namespace tessera::bench
