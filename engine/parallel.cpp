#include "engine/parallel.h"

#include <algorithm>
#include <atomic>
#include <vector>

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task.h>
#include <oneapi/tbb/task_arena.h>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace tessera {

namespace tbb = oneapi::tbb;

struct Parallel::Arena {
  explicit Arena(int threads) : arena(threads), seen(static_cast<std::size_t>(threads)) {}
  tbb::task_arena arena;
  std::vector<std::atomic<bool>> seen;
};

Parallel::Parallel(int threads) : threads_(threads) {
  // An arena above the process's limit would make oneTBB print a warning and not run more threads anyway.
  const auto limit = static_cast<int>(tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
  threads_ = std::clamp(threads, 1, std::max(1, limit));
  arena_ = std::make_unique<Arena>(threads_);
}
Parallel::~Parallel() = default;
Parallel::Parallel(Parallel&&) noexcept = default;
Parallel& Parallel::operator=(Parallel&&) noexcept = default;

void Parallel::for_each(std::size_t count, const std::function<void(std::size_t, int)>& task) {
  if (count == 0) return;
  if (threads_ == 1) {
    const FloatingPointMode mode;
    arena_->seen[0] = true;
    for (std::size_t i = 0; i < count; ++i) task(i, 0);
    return;
  }
  // Workers take the next task in order when they are free, so that callers can put the long ones first.
  std::atomic<std::size_t> next{0};
  const int workers = static_cast<int>(std::min<std::size_t>(static_cast<std::size_t>(threads_), count));
  arena_->arena.execute([&] {
    tbb::parallel_for(
        tbb::blocked_range<int>(0, workers, 1),
        [&](const tbb::blocked_range<int>&) {
          const FloatingPointMode mode;
          const int worker = tbb::this_task_arena::current_thread_index();
          arena_->seen[static_cast<std::size_t>(worker)].store(true, std::memory_order_relaxed);
          for (std::size_t i = next.fetch_add(1); i < count && !tbb::is_current_task_group_canceling(); i = next.fetch_add(1)) task(i, worker);
        },
        tbb::simple_partitioner());
  });
}

int Parallel::distinct_workers_seen() {
  int count = 0;
  for (std::atomic<bool>& seen : arena_->seen) count += seen.exchange(false) ? 1 : 0;
  return count;
}

int available_cores() { return std::max(1, tbb::info::default_concurrency()); }

struct ThreadLimit::Control {
  explicit Control(int threads) : control(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads)) {}
  tbb::global_control control;
};
ThreadLimit::ThreadLimit(int threads) : control_(std::make_unique<Control>(threads)) {}
ThreadLimit::~ThreadLimit() = default;

#if defined(__x86_64__)
FloatingPointMode::FloatingPointMode() : saved_(_mm_getcsr()) {
  _mm_setcsr(0x1f80);  // exceptions masked, round to nearest, neither FTZ nor DAZ
}
FloatingPointMode::~FloatingPointMode() { _mm_setcsr(static_cast<unsigned>(saved_)); }
#elif defined(__aarch64__)
FloatingPointMode::FloatingPointMode() {
  __asm__ volatile("mrs %0, fpcr" : "=r"(saved_));
  __asm__ volatile("msr fpcr, %0" : : "r"(0ULL));
}
FloatingPointMode::~FloatingPointMode() { __asm__ volatile("msr fpcr, %0" : : "r"(saved_)); }
#else
#error "FloatingPointMode: name the floating-point control register of this architecture"
#endif

}  // namespace tessera
