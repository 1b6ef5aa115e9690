// Progress, cancellation, exceptions of the caller, and log messages.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <deque>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "engine/program/threads/thread_limit.h"
#include "tests/engine/frame/api_random_frame.h"
#include "tests/engine/runtime/test_executors.h"

namespace tessera::callbacks_test {
using namespace detail;
using namespace program;
namespace {

using namespace test;

const RandomFrame& scene() {
  static const RandomFrame frame({.width = 420, .height = 260}, 600);
  return frame;
}

Fingerprint finished(Renderer& renderer, FrameBuffer& buffer) {
  Frame frame(buffer);
  scene().record(frame);
  renderer.finish(frame);
  return fingerprint(buffer);
}

TEST(Progress, RisesToOneAndIsNeverCalledConcurrently) {
  for (const int threads : {1, 2}) {
    std::vector<double> calls;
    std::atomic<int> inside = 0;
    bool shared = false;
    Renderer renderer({.threads = threads, .progress = [&](double done) {
                         shared |= inside.fetch_add(1) != 0;
                         calls.push_back(done);
                         --inside;
                         return true;
                       }});
    FrameBuffer buffer(scene().format);
    const Fingerprint watched = finished(renderer, buffer);
    EXPECT_FALSE(shared);
    ASSERT_GE(calls.size(), 2u);
    EXPECT_TRUE(std::is_sorted(calls.begin(), calls.end()));
    EXPECT_GT(calls.front(), 0);
    EXPECT_DOUBLE_EQ(calls.back(), 1);
    Renderer plain({.threads = 1});
    EXPECT_EQ(watched, finished(plain, buffer));
  }
}

// From the callback's thread and from another one: neither may wait for workers that wait for the callback.
TEST(Progress, CallbackMayRecordTheNextFrameWithTheSameRenderer) {
  const std::vector<float> triangle{-1, -1, 0, 1, -1, 0, 0, 1, 0};
  std::vector<std::uint32_t> many(90'000);
  for (std::size_t i = 0; i < many.size(); ++i) many[i] = static_cast<std::uint32_t>(i % 3);
  many.back() = 3;  // out of range: found only if all indices are checked
  Renderer plain({.threads = 1});
  FrameBuffer fresh(scene().format);
  const Fingerprint expected = finished(plain, fresh);
  for (const int threads : {1, 2, 8, 0}) {  // 0: three workers of an executor
    const ThreadLimit limit(std::max(1, threads));
    Renderer* helper = nullptr;
    int drawn = 0;
    int refused = 0;
    const std::shared_ptr<Executor> executor =
        threads == 0 ? std::make_shared<ThreadPerCallExecutor>(3) : nullptr;
    Renderer renderer({.threads = threads, .tile_size = 32, .executor = executor, .progress = [&](double) {
                         const auto draw = [&] {
                           FrameBuffer next_buffer({.width = 8, .height = 8});
                           Frame next(next_buffer, *helper);
                           refused +=
                               error_of([&] { next.draw({.positions = triangle, .indices = many}); }) ? 1 : 0;
                         };
                         if (++drawn % 2 == 0) draw();
                         else std::thread(draw).join();
                         return true;
                       }});
    helper = &renderer;
    for (int round = 0; round < 10; ++round) {
      FrameBuffer buffer(scene().format);
      EXPECT_EQ(finished(renderer, buffer), expected);
    }
    EXPECT_GE(drawn, 20);
    EXPECT_EQ(refused, drawn);
  }
}

/// Records how deeply its calls nest.
class NestingExecutor : public SingleThreadExecutor {
 public:
  NestingExecutor() : SingleThreadExecutor(3) {}
  void run(int count, void (*work)(void*, int), void* context) override {
    deepest = std::max(deepest, ++depth_);
    SingleThreadExecutor::run(count, work, context);
    --depth_;
  }
  int deepest = 0;

 private:
  int depth_ = 0;
};

/// A single thread that runs any pending job while it waits, including jobs of a call that it is already
/// inside.
class SingleThreadQueue : public Executor {
 public:
  int workers() const noexcept override { return 3; }
  void run(int count, void (*work)(void*, int), void* context) override {
    int left = count;
    for (int k = 0; k < count; ++k)
      jobs_.push_back([&left, work, context, k] {
        work(context, k);
        --left;
      });
    while (left > 0) {
      const std::function<void()> job = std::move(jobs_.front());
      jobs_.pop_front();
      job();
    }
  }

 private:
  std::deque<std::function<void()>> jobs_;
};

/// Finishes frames of another renderer with the same executor in the middle of a frame, and checks both
/// results.
void expect_frames_within_a_frame(const std::shared_ptr<Executor>& executor) {
  Renderer plain({.threads = 1});
  FrameBuffer fresh(scene().format);
  const Fingerprint expected = finished(plain, fresh);
  Renderer other({.executor = executor});
  int calls = 0;
  Renderer renderer({.executor = executor, .progress = [&](double) {
                       if (++calls <= 3) {
                         FrameBuffer buffer(scene().format);
                         EXPECT_EQ(finished(other, buffer), expected);
                       }
                       return true;
                     }});
  FrameBuffer buffer(scene().format);
  EXPECT_EQ(finished(renderer, buffer), expected);
  EXPECT_GE(calls, 3);
}

TEST(Progress, CallbackMayUseAnotherRendererOfTheSameExecutor) {
  const auto depth = std::make_shared<NestingExecutor>();
  Renderer alone({.executor = depth});
  FrameBuffer buffer(scene().format);
  finished(alone, buffer);
  EXPECT_EQ(depth->deepest, 1);
  expect_frames_within_a_frame(depth);
  EXPECT_EQ(depth->deepest, 2) << "the executor runs the nested frames";
  expect_frames_within_a_frame(std::make_shared<ThreadPerCallExecutor>(3));
  expect_frames_within_a_frame(std::make_shared<SingleThreadQueue>());
}

TEST(Progress, CallbackMustNotFinishFramesOfItsRenderer) {
  Renderer plain({.threads = 1});
  FrameBuffer buffer(scene().format);
  const Fingerprint expected = finished(plain, buffer);
  for (const int threads : {1, 2}) {
    Renderer* self = nullptr;
    FrameBuffer next_buffer({.width = 8, .height = 8});
    Frame next(next_buffer);
    next.clear({.color = Color{0, 0, 1, 1}});
    std::vector<std::string> errors;
    int calls = 0;
    Renderer renderer({.threads = threads, .progress = [&](double) {
                         ++calls;
                         errors.push_back(error_of([&] { self->finish(next); }).value_or(""));
                         return true;
                       }});
    self = &renderer;
    EXPECT_EQ(finished(renderer, buffer), expected);
    ASSERT_GE(calls, 2);
    EXPECT_THAT(errors, testing::Each(testing::HasSubstr("called by this renderer's own progress callback")));
    plain.finish(next);
    EXPECT_THAT(packed_colors(next_buffer), testing::AllOf(testing::SizeIs(64), testing::Each(0x0000ffu)))
        << "the frame is still recorded";
  }
}

// Cancels a frame at the given call of the callback, for each call in turn, then finishes it.
template <class End>
void end_at_every_call(const End& expect_end) {
  Renderer plain({.threads = 1});
  FrameBuffer fresh(scene().format);
  const Fingerprint expected = finished(plain, fresh);
  bool ended = true;
  for (int at = 0; ended; ++at) {
    ASSERT_LT(at, 1000);
    int call = 0;
    bool armed = true;
    ended = false;
    Renderer renderer({.threads = 1, .progress = [&](double) {
                         if (!armed || call++ != at) return true;
                         ended = true;
                         return false;
                       }});
    FrameBuffer buffer(scene().format);
    Frame frame(buffer);
    scene().record(frame);
    const std::size_t draws = frame.draw_count();
    if (!expect_end(renderer, frame)) break;
    if (!ended) break;
    armed = false;
    EXPECT_EQ(frame.draw_count(), draws) << "still recorded";
    packed_colors(buffer);  // does not throw
    renderer.finish(frame);
    EXPECT_EQ(fingerprint(buffer), expected) << "after call " << at;
    EXPECT_EQ(frame.draw_count(), 0u);
  }
}

TEST(Progress, CancelledFrameCanBeFinishedLater) {
  int cancelled = 0;
  end_at_every_call([&](Renderer& renderer, Frame& frame) {
    try {
      renderer.finish(frame);
      return false;
    } catch (const Cancelled& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr("cancelled"));
      ++cancelled;
      return true;
    }
  });
  EXPECT_GE(cancelled, 2);
}

// Cancels at arbitrary points of both threads.
TEST(Progress, CanCancelWhileTwoThreadsWork) {
  Renderer plain({.threads = 1});
  FrameBuffer fresh(scene().format);
  const Fingerprint expected = finished(plain, fresh);
  int cancelled = 0;
  for (int round = 0; round < 20; ++round) {
    bool armed = true;
    Renderer renderer({.threads = 2, .tile_size = 32, .progress = [&](double done) {
                         return !armed || done < round / 20.0;
                       }});
    const std::size_t size = FrameBuffer::memory_bytes(scene().format);
    std::vector<std::byte> memory(size + 64);
    void* at = memory.data();
    std::size_t space = memory.size();
    std::align(64, size, at, space);
    FrameBuffer own(scene().format);
    FrameBuffer lent(scene().format, {static_cast<std::byte*>(at), size});
    for (FrameBuffer* buffer : {&own, &lent}) {
      armed = true;
      Frame frame(*buffer);
      scene().record(frame);
      try {
        renderer.finish(frame);
      } catch (const Cancelled&) {
        ++cancelled;
        packed_colors(*buffer);  // does not throw
      }
      armed = false;
      if (frame.draw_count() == 0) scene().record(frame);
      renderer.finish(frame);
      EXPECT_EQ(fingerprint(*buffer), expected) << "round " << round;
    }
  }
  EXPECT_EQ(cancelled, 40) << "the last call reports 1";
}

TEST(Progress, CallersExceptionReachesTheCaller) {
  struct OwnError {
    int number;
  };
  for (const int threads : {1, 2}) {
    bool armed = true;
    Renderer renderer({.threads = threads, .progress = [&](double done) {
                         if (armed && done > 0.5) throw OwnError{42};
                         return true;
                       }});
    FrameBuffer buffer(scene().format);
    Frame frame(buffer);
    scene().record(frame);
    try {
      renderer.finish(frame);
      FAIL();
    } catch (const OwnError& error) {
      EXPECT_EQ(error.number, 42);
    }
    armed = false;
    renderer.finish(frame);
    Renderer plain({.threads = 1});
    FrameBuffer fresh(scene().format);
    EXPECT_EQ(fingerprint(buffer), finished(plain, fresh));
  }
}

TEST(Progress, CancelledFrameHoldsOnlyOldAndNewTiles) {
  // The previous frame has one colour, the cancelled one another; no third colour may appear. Tiles are slow
  // enough for a progress call between two of them.
  int call = 0;
  bool armed = false;
  class Slow : public Executor {
   public:
    int workers() const noexcept override { return 1; }
    void run(int count, void (*work)(void*, int), void* context) override {
      for (int k = 0; k < count; ++k) work(context, k);
    }
  };
  Renderer renderer({.tile_size = 32, .executor = std::make_shared<Slow>(), .progress = [&](double done) {
                       if (armed)
                         std::this_thread::sleep_for(
                             std::chrono::milliseconds(15));  // longer than the interval between two calls
                       return !armed || done < 0.5 || call++ < 3;
                     }});
  FrameBuffer buffer({.width = 300, .height = 200});
  Frame frame(buffer);
  const MeshData whole = whole_window();
  frame.draw(whole.view(), unlit({1, 0, 0, 1}));
  renderer.finish(frame);
  armed = true;
  frame.clear({.depth = 1.0});
  for (int i = 0; i < 200; ++i)
    frame.draw(whole.view(), [] {
      DrawState s = unlit({0, 1, 0, 1});
      s.depth.test = Compare::always;
      return s;
    }());
  EXPECT_THROW(renderer.finish(frame), Cancelled);
  std::size_t before = 0;
  std::size_t after = 0;
  for (const std::uint32_t word : packed_colors(buffer)) {
    ASSERT_TRUE(word == 0xff0000u || word == 0x00ff00u) << std::hex << word;
    ++(word == 0xff0000u ? before : after);
  }
  EXPECT_GT(before, 0u);
  EXPECT_GT(after, 0u);
}

TEST(Log, NamesTheKernelsAndWarnsOfDroppedTriangles) {
  std::vector<std::pair<LogLevel, std::string>> lines;
  Renderer renderer(
      {.threads = 1, .log = [&](LogLevel level, std::string_view text) { lines.emplace_back(level, text); }});
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0].first, LogLevel::info);
  EXPECT_THAT(lines[0].second, testing::HasSubstr("1 thread, "));
  FrameBuffer buffer({.width = 16, .height = 16});
  Frame frame(buffer);
  MeshData mesh = whole_window();
  mesh.positions[0] = std::numeric_limits<float>::quiet_NaN();
  frame.draw(mesh.view(), {});
  renderer.finish(frame);
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_EQ(lines[1].first, LogLevel::warning);
  EXPECT_THAT(lines[1].second, testing::HasSubstr("2 triangles, lines or points with a NaN"));
  EXPECT_EQ(lines[2].first, LogLevel::debug);
}

}  // namespace
}  // namespace tessera::callbacks_test
