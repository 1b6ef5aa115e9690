// Work in the background whose results are taken in order.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <future>
#include <mutex>
#include <thread>
#include <vector>

namespace tessera::program {

/// Runs tasks on separate threads, while the caller makes the next ones.
/// - A task may have a last step, which runs in the calling thread, in the order of the tasks.
/// - Call from one thread at a time.
class TaskQueue {
 public:
  /// @param threads    1: no thread is started, and add() runs the task; 2 or more: threads
  /// @param max_tasks  tasks that may be unfinished at a time, at least 1; bounds the memory they hold
  TaskQueue(int threads, int max_tasks);
  /// Leaves out tasks that have not begun; waits for the others.
  ~TaskQueue();
  TaskQueue(const TaskQueue&) = delete;
  TaskQueue& operator=(const TaskQueue&) = delete;

  /// Waits until fewer than max_tasks are unfinished, and adds one.
  /// @throws the exception of the first task in order that failed; then only the destructor may follow
  void add(std::function<void()> task, const std::function<void()>& last_step);
  /// Waits for all tasks.
  /// @throws as add()
  void finish();

 private:
  struct Pending {
    std::future<void> done;
    std::function<void()> last_step;
  };

  void work();
  void finish_first();

  const std::size_t max_tasks_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::packaged_task<void()>> waiting_;  ///< not begun; guarded by mutex_
  bool is_ending_ = false;                          ///< guarded by mutex_
  std::deque<Pending> pending_;                     ///< in order; used by the calling thread alone
  std::vector<std::jthread> threads_;
};

}  // namespace tessera::program
