#include "engine/runtime/frame_trace.h"

#include <algorithm>
#include <new>

namespace tessera::detail {

void FrameTrace::WorkerTasks::add(const FrameTask& task) noexcept try {
  list.push_back(task);
} catch (const std::bad_alloc&) {
  is_complete = false;
}

std::vector<FrameTask> FrameTrace::tasks() const noexcept try {
  std::vector<FrameTask> all;
  for (const WorkerTasks& of_worker : tasks_) {
    if (!of_worker.is_complete) return {};
    all.insert(all.end(), of_worker.list.begin(), of_worker.list.end());
  }
  const auto began_before = [](const FrameTask& a, const FrameTask& b) { return a.begin < b.begin; };
  if (!std::is_sorted(all.begin(), all.end(), began_before))
    std::stable_sort(all.begin(), all.end(), began_before);
  return all;
} catch (const std::bad_alloc&) {
  return {};
}

}  // namespace tessera::detail
