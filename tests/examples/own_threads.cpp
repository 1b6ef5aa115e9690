// The work of frames on a thread pool of the caller's own: twenty lines of it.
#include <tessera/tessera.hpp>

#include <condition_variable>
#include <cstdio>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

class Pool : public tessera::Executor {
 public:
  explicit Pool(int threads) {
    for (int i = 1; i < threads; ++i) threads_.emplace_back([this] { serve(); });
  }
  ~Pool() override {
    { const std::lock_guard lock(mutex_); ends_ = true; }
    wake_.notify_all();
    for (std::thread& thread : threads_) thread.join();
  }
  int workers() const noexcept override { return static_cast<int>(threads_.size()) + 1; }

  void run(int count, void (*work)(void*, int), void* context) override {
    {
      const std::lock_guard lock(mutex_);
      work_ = work, context_ = context, next_ = 0, count_ = count, busy_ = 0;
    }
    wake_.notify_all();
    take();  // the caller works, too
    std::unique_lock lock(mutex_);
    done_.wait(lock, [this] { return next_ == count_ && busy_ == 0; });
  }

 private:
  void serve() {
    for (;;) {
      {
        std::unique_lock lock(mutex_);
        wake_.wait(lock, [this] { return ends_ || next_ < count_; });
        if (ends_) return;
      }
      take();
    }
  }
  void take() {
    std::unique_lock lock(mutex_);
    while (next_ < count_) {
      const int worker = next_++;
      ++busy_;
      lock.unlock();
      work_(context_, worker);
      lock.lock();
      --busy_;
    }
    done_.notify_all();
  }

  std::mutex mutex_;
  std::condition_variable wake_, done_;
  std::vector<std::thread> threads_;
  void (*work_)(void*, int) = nullptr;
  void* context_ = nullptr;
  int next_ = 0, count_ = 0, busy_ = 0;
  bool ends_ = false;
};

int main() {
  const float positions[] = {-1, -1, 0, 1, -1, 0, 0, 1, 0};
  const auto picture = [&](tessera::RendererOptions options) {
    tessera::Renderer renderer(std::move(options));
    tessera::FrameBuffer buffer({.width = 300, .height = 200});
    tessera::Frame frame(buffer);
    frame.clear({.color = tessera::Color{0, 0, 0.2f, 1}, .depth = 1.0});
    frame.draw({.positions = positions}, {});
    std::vector<unsigned char> pixels(300 * 200 * 4);
    renderer.finish(frame, {.pixels = pixels.data(), .width = 300, .height = 200, .stride_bytes = 1200});
    return pixels;
  };
  const bool same = picture({.executor = std::make_shared<Pool>(3)}) == picture({.threads = 1});
  std::printf("a pool of three draws %s as one thread\n", same ? "the same" : "something else");
  return same ? 0 : 1;
}
