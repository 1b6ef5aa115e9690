// A loop over parts of a picture on the caller's threads.
#pragma once

#include <algorithm>
#include <atomic>
#include <exception>

#include "framebuffer/tessera/screen.hpp"

namespace tessera::detail {

/// Calls task(part) for each part from 0 to count - 1, each once, in any order and from several threads.
/// @throws the first exception of a task; tasks that have not begun are then left out
template <class Task>
void parallel_parts(const ScreenWorkers& workers, int count, const Task& task) {
  struct Shared {
    const Task& task;
    int count;
    std::atomic<int> next{0};
    std::atomic_flag has_failed{};
    std::exception_ptr failure{};
  } shared{task, count};
  const auto work = [](void* context, int) {
    auto& parts = *static_cast<Shared*>(context);
    try {
      for (int part = parts.next++; part < parts.count; part = parts.next++) parts.task(part);
    } catch (...) {
      parts.next = parts.count;
      if (!parts.has_failed.test_and_set()) parts.failure = std::current_exception();
    }
  };
  const int threads = std::min(workers.count, count);
  if (workers.run == nullptr || threads <= 1) work(&shared, 0);
  else workers.run(workers.executor, threads, work, &shared);
  if (shared.failure) std::rethrow_exception(shared.failure);
}

}  // namespace tessera::detail
