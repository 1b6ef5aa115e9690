// Runs the work of frames on the caller's thread pool. Two renderers share the pool and draw at the same
// time.
#include <tessera/tessera.hpp>

#include <algorithm>
#include <condition_variable>
#include <cstdio>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

// The list of jobs is needed because several renderers may call run() at the same time, or one of them within
// a task of another. A single renderer needs only one job at a time.
class Pool : public tessera::Executor {
 public:
  explicit Pool(int threads) {
    for (int i = 1; i < threads; ++i) threads_.emplace_back([this] { serve(); });
  }
  ~Pool() override {
    {
      const std::lock_guard lock(mutex_);
      ends_ = true;
    }
    wake_.notify_all();
    for (std::thread& thread : threads_) thread.join();
  }
  int workers() const noexcept override { return static_cast<int>(threads_.size()) + 1; }

  void run(int count, void (*work)(void*, int), void* context) override {
    Job job{work, context, count};
    std::unique_lock lock(mutex_);
    jobs_.push_back(&job);
    wake_.notify_all();
    while (job.begun < job.count) take(job, lock);  // the caller works on this job only
    done_.wait(lock, [&] { return job.ended == job.count; });
    std::erase(jobs_, &job);
  }

 private:
  struct Job {
    void (*work)(void*, int);
    void* context;
    int count;
    int begun = 0;
    int ended = 0;
  };
  void serve() {
    std::unique_lock lock(mutex_);
    while (!ends_) {
      const auto job =
          std::find_if(jobs_.begin(), jobs_.end(), [](const Job* any) { return any->begun < any->count; });
      if (job == jobs_.end()) wake_.wait(lock);
      else take(**job, lock);
    }
  }
  void take(Job& job, std::unique_lock<std::mutex>& lock) {
    const int worker = job.begun++;
    lock.unlock();
    job.work(job.context, worker);
    lock.lock();
    if (++job.ended == job.count) done_.notify_all();
  }

  std::mutex mutex_;
  std::condition_variable wake_;
  std::condition_variable done_;
  std::vector<std::thread> threads_;
  std::vector<Job*> jobs_;
  bool ends_ = false;
};

int main() {
  const float positions[] = {-1, -1, 0, 1, -1, 0, 0, 1, 0};
  const auto picture = [&](tessera::RendererOptions options) {
    tessera::Renderer renderer(std::move(options));
    tessera::FrameBuffer buffer({.width = 300, .height = 200});
    tessera::Frame frame(buffer);
    std::vector<unsigned char> pixels(300 * 200 * 4);
    for (int i = 0; i < 20; ++i) {
      frame.clear({.color = tessera::Color{0, 0, 0.2f, 1}, .depth = 1.0});
      frame.draw({.positions = positions}, {.transform = tessera::rotate(10.0 * i, 0, 0, 1)});
      renderer.finish(frame, {.pixels = pixels.data(), .width = 300, .height = 200, .stride_bytes = 1200});
    }
    return pixels;
  };
  const auto pool = std::make_shared<Pool>(3);
  std::vector<unsigned char> other;
  std::thread beside([&] { other = picture({.executor = pool}); });
  const auto own = picture({.executor = pool});
  beside.join();
  const auto expected = picture({.threads = 1});
  const bool same = own == expected && other == expected;
  std::printf("two renderers on a pool of three draw %s as one thread\n",
              same ? "the same" : "something else");
  return same ? 0 : 1;
}
