#include "engine/program/threads/task_queue.h"

#include <system_error>
#include <utility>

namespace tessera::program {

TaskQueue::TaskQueue(int threads, int max_tasks) : max_tasks_(static_cast<std::size_t>(max_tasks)) {
  if (threads > 1) threads_.reserve(static_cast<std::size_t>(threads));
  try {
    for (int i = 0; threads > 1 && i < threads; ++i) threads_.emplace_back([this] { work(); });
  } catch (const std::system_error&) {
    // The system allows no more threads; those that run do the work, or add() does.
  }
}

TaskQueue::~TaskQueue() {
  {
    const std::lock_guard lock(mutex_);
    waiting_.clear();
    is_ending_ = true;
  }
  changed_.notify_all();
}

void TaskQueue::add(std::function<void()> task, const std::function<void()>& last_step) {
  while (pending_.size() >= max_tasks_) finish_first();
  std::packaged_task<void()> packaged(std::move(task));
  pending_.push_back({packaged.get_future(), last_step});
  if (threads_.empty()) {
    packaged();
    return finish();
  }
  {
    const std::lock_guard lock(mutex_);
    waiting_.push_back(std::move(packaged));
  }
  changed_.notify_one();
}

void TaskQueue::finish() {
  while (!pending_.empty()) finish_first();
}

void TaskQueue::finish_first() {
  Pending first = std::move(pending_.front());
  pending_.pop_front();
  first.done.get();
  if (first.last_step) first.last_step();
}

void TaskQueue::work() {
  for (;;) {
    std::packaged_task<void()> task;
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [this] { return is_ending_ || !waiting_.empty(); });
      if (is_ending_) return;
      task = std::move(waiting_.front());
      waiting_.pop_front();
    }
    task();
  }
}

}  // namespace tessera::program
