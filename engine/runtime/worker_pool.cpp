#include "engine/runtime/worker_pool.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <numeric>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include "engine/runtime/floating_point_mode.h"

namespace tessera::detail {

namespace tbb = oneapi::tbb;

namespace {

/// Threads of oneTBB in a separate arena, so that progress callbacks may use oneTBB, too. With two threads,
/// each keeps its worker number from call to call; with more, the assignment varies.
class ArenaExecutor : public Executor {
 public:
  explicit ArenaExecutor(int threads) : threads_(threads), arena_(threads) {}
  int workers() const noexcept override { return threads_; }
  void run(int count, void (*work)(void*, int), void* context) override {
    arena_.execute([&] {
      tbb::parallel_for(
          tbb::blocked_range<int>(0, count, 1),
          [&](const tbb::blocked_range<int>& range) { work(context, range.begin()); },
          tbb::simple_partitioner());
    });
  }

 private:
  int threads_;
  tbb::task_arena arena_;
};

class SerialExecutor : public Executor {
 public:
  int workers() const noexcept override { return 1; }
  void run(int count, void (*work)(void*, int), void* context) override {
    for (int k = 0; k < count; ++k) work(context, k);
  }
};

/// Permutation of tasks: task number i becomes (i * step + order) mod count, with step coprime to count.
class TaskOrder {
 public:
  TaskOrder(std::uint32_t order, std::size_t count) : order_(order), count_(count) {
    if (order == 0) return;
    step_ = 1 + std::size_t{order} * 2654435761u % count;
    while (std::gcd(step_, count) != 1) ++step_;
  }
  std::size_t operator()(std::size_t i) const { return order_ == 0 ? i : (i * step_ + order_) % count_; }

 private:
  std::uint32_t order_;
  std::size_t count_;
  std::size_t step_ = 1;
};

/// Sets a flag until the end of the scope.
class ScopedFlag {
 public:
  explicit ScopedFlag(bool& flag) : flag_(flag) { flag_ = true; }
  ~ScopedFlag() { flag_ = false; }
  ScopedFlag(const ScopedFlag&) = delete;
  ScopedFlag& operator=(const ScopedFlag&) = delete;

 private:
  bool& flag_;
};

std::shared_ptr<Executor> make_serial_executor() { return std::make_shared<SerialExecutor>(); }

}  // namespace

/// Tasks of one call.
struct WorkerPool::Dispatch {
  const TaskRef& task;
  const TaskOrder order;
  const std::span<Share> shares;
  std::atomic<std::size_t> done{0};
  std::atomic<bool> failed{false};
  std::exception_ptr failure{};
  std::atomic<int> invalid_worker{0};  // a worker out of range that the executor passed; 0: none

  static void work(void* dispatch, int worker) noexcept { static_cast<Dispatch*>(dispatch)->run(worker); }
  void run(int worker) noexcept {
    const FloatingPointMode mode;
    const auto own = static_cast<std::size_t>(worker);
    if (own >= shares.size()) {
      invalid_worker.store(worker, std::memory_order_release);
      return;
    }
    std::size_t ran = 0;
    std::size_t s = own;
    do {
      ran += run_share(shares[s], worker);
      if (++s == shares.size()) s = 0;
    } while (s != own);
    if (ran == 0) return;
    shares[own].has_run = true;
    done.fetch_add(ran, std::memory_order_release);
  }
  /// @return  tasks that this worker ran
  std::size_t run_share(Share& share, int worker) noexcept {
    std::size_t ran = 0;
    // Load before the read-modify-write: a load leaves the cache line shared.
    while (share.next.load(std::memory_order_relaxed) < share.end &&
           !failed.load(std::memory_order_relaxed)) {
      const std::size_t i = share.next.fetch_add(1, std::memory_order_relaxed);
      if (i >= share.end) break;
      ++ran;
      try {
        task.call(task.self, order(i), worker);
      } catch (...) {
        if (!failed.exchange(true)) failure = std::current_exception();
      }
    }
    return ran;
  }
};

WorkerPool::WorkerPool(int threads, std::shared_ptr<Executor> executor, std::uint32_t order)
    : executor_(std::move(executor)), order_(order) {
  if (executor_) {
    threads_ = std::clamp(threads, 1, std::max(1, executor_->workers()));
  } else {
    // An arena above the process's limit runs no more threads, and makes oneTBB print a warning.
    const auto limit =
        static_cast<int>(tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
    threads_ = std::clamp(threads, 1, std::max(1, limit));
    executor_ = threads_ == 1 ? make_serial_executor() : std::make_shared<ArenaExecutor>(threads_);
  }
  shares_ = std::vector<Share>(static_cast<std::size_t>(threads_));
}
WorkerPool::~WorkerPool() = default;
WorkerPool::WorkerPool(WorkerPool&&) noexcept = default;
WorkerPool& WorkerPool::operator=(WorkerPool&&) noexcept = default;

void WorkerPool::run(std::size_t count, const TaskRef& task) {
  if (count == 0) return;
  const TaskOrder order(order_, count);
  if (is_running_) {
    // Nested call: run serially on this thread. The other workers belong to the outer call; waiting for them
    // could deadlock.
    const FloatingPointMode mode;
    for (std::size_t i = 0; i < count; ++i) task.call(task.self, order(i), 0);
    return;
  }
  const std::size_t workers = workers_for(count);
  const std::span<Share> shares = std::span(shares_).first(workers);
  for (std::size_t s = 0, first = 0; s < workers; ++s) {
    shares[s].next.store(first, std::memory_order_relaxed);
    shares[s].end = first = first_of_share(count, workers, s + 1);
  }
  Dispatch dispatch{task, order, shares};
  {
    const ScopedFlag running(is_running_);
    executor_->run(static_cast<int>(workers), &Dispatch::work, &dispatch);
  }
  if (dispatch.failure) std::rethrow_exception(dispatch.failure);
  if (const int invalid_worker = dispatch.invalid_worker.load(std::memory_order_acquire); invalid_worker != 0)
    throw Error(ErrorCode::executor_failure,
                "Renderer: the executor called work for worker " + std::to_string(invalid_worker) +
                    ", run() must call it for 0 .. " + std::to_string(workers - 1));
  if (dispatch.done.load(std::memory_order_acquire) != count)
    throw Error(
        ErrorCode::executor_failure,
        "Renderer: the executor returned before its work was done; run() must call work for each worker and "
        "wait for all of them");
}

int WorkerPool::distinct_workers_seen() {
  int count = 0;
  for (Share& share : shares_) count += std::exchange(share.has_run, false) ? 1 : 0;
  return count;
}

void run_isolated(const std::function<void()>& run) { tbb::this_task_arena::isolate(run); }

int default_concurrency() { return std::max(1, tbb::info::default_concurrency()); }

}  // namespace tessera::detail

namespace tessera {

std::shared_ptr<Executor> serial_executor() { return detail::make_serial_executor(); }

}  // namespace tessera
