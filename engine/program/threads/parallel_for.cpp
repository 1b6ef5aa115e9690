#include "engine/program/threads/parallel_for.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

#include "engine/program/threads/thread_limit.h"

namespace tessera::program {

void parallel_for(int count, int threads, const std::function<std::function<void(int)>()>& make_task) {
  std::atomic<int> next{0};
  std::exception_ptr failure;
  std::mutex failure_mutex;
  const auto work = [&] {
    try {
      const std::function<void(int)> task = make_task();
      for (int i = next++; i < count; i = next++) task(i);
    } catch (...) {
      const std::lock_guard lock(failure_mutex);
      if (!failure) failure = std::current_exception();
      next = count;
    }
  };
  const int used_threads = std::min(threads == 0 ? available_cores() : threads, count);
  {
    std::vector<std::jthread> helpers;
    try {
      for (int i = 1; i < used_threads; ++i) helpers.emplace_back(work);
    } catch (const std::system_error&) {
      // The system allows no more threads; those that run do the work.
    }
    work();
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace tessera::program
