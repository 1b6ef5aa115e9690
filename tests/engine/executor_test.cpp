// Whoever runs the work, the picture is the same.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <thread>

#include "tests/engine/api_random_frame.h"

namespace tessera {
namespace {

using namespace test;

// Threads that are made for each call: the simplest pool there is.
class OwnThreads : public Executor {
 public:
  explicit OwnThreads(int count) : count_(count) {}
  int workers() const noexcept override { return count_; }
  void run(int count, void (*work)(void*, int), void* context) override {
    std::vector<std::thread> threads;
    for (int k = 0; k < count; ++k) threads.emplace_back(work, context, k);
    for (std::thread& thread : threads) thread.join();
    ++runs;
  }
  int runs = 0;

 private:
  int count_;
};

class Backwards : public Executor {
 public:
  int workers() const noexcept override { return 5; }
  void run(int count, void (*work)(void*, int), void* context) override {
    for (int k = count; k-- > 0;) work(context, k);
  }
};

class Idle : public Executor {
 public:
  int workers() const noexcept override { return 2; }
  void run(int, void (*)(void*, int), void*) override {}
};

class Throwing : public Executor {
 public:
  int workers() const noexcept override { return 2; }
  void run(int, void (*)(void*, int), void*) override { throw std::length_error("no threads today"); }
};

class Nobody : public Executor {
 public:
  int workers() const noexcept override { return 0; }
  void run(int, void (*)(void*, int), void*) override {}
};

Fingerprint drawn(RendererOptions options) {
  const RandomFrame scene({.width = 210, .height = 130}, 300);
  Renderer renderer(std::move(options));
  FrameBuffer buffer(scene.format);
  Frame frame(buffer);
  scene.record(frame);
  renderer.finish(frame);
  return fingerprint(buffer);
}

TEST(Executors, GiveTheSameBits) {
  const Fingerprint expected = drawn({.threads = 1});
  EXPECT_EQ(drawn({.executor = serial_executor()}), expected);
  const auto own = std::make_shared<OwnThreads>(3);
  EXPECT_EQ(drawn({.executor = own}), expected);
  EXPECT_GT(own->runs, 2);
  EXPECT_EQ(drawn({.executor = std::make_shared<Backwards>()}), expected);
}

TEST(Executors, NumberOfWorkersIsTheNumberOfThreads) {
  EXPECT_EQ(Renderer({.executor = std::make_shared<OwnThreads>(3)}).options().threads, 3);
  EXPECT_EQ(Renderer({.threads = 2, .executor = std::make_shared<OwnThreads>(3)}).options().threads, 2);
  EXPECT_EQ(Renderer({.threads = 9, .executor = std::make_shared<OwnThreads>(3)}).options().threads, 3);
}

TEST(Executors, ThatDoNotDoTheirWorkAreNamed) {
  EXPECT_THAT(error_of([] { drawn({.executor = std::make_shared<Idle>()}); }).value_or(""), testing::HasSubstr("executor returned before its work was done"));
  EXPECT_THAT(error_of([] { Renderer({.executor = std::make_shared<Nobody>()}); }).value_or(""), testing::HasSubstr("0 workers"));
  EXPECT_THROW(drawn({.executor = std::make_shared<Throwing>()}), std::length_error) << "its own exceptions pass through";
}

}  // namespace
}  // namespace tessera
