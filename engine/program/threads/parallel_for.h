// A parallel loop for work of the program itself. The renderer has its worker pool.
#pragma once

#include <functional>

namespace tessera::program {

/// Calls task(0) to task(count - 1), each once, from several threads at a time, in any order.
/// - Starts up to `threads` - 1 threads, and ends them before it returns; the calling thread takes part.
/// - If a task throws, tasks that have not begun are left out.
/// @param threads    1 or more; 0: available_cores()
/// @param make_task  called once in each thread; the task it returns may own memory that its calls reuse
/// @throws the first exception of a task
void parallel_for(int count, int threads, const std::function<std::function<void(int)>()>& make_task);

}  // namespace tessera::program
