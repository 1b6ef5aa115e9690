// Two concurrent workloads that wait for each other to prove that they overlap.
#include "perf/bench/independent_renderers.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>

#include <gtest/gtest.h>

#include "engine/program/threads/thread_limit.h"

namespace tessera::bench::independent_renderers_test {
using namespace program;
namespace {

struct Rendezvous {
  std::mutex mutex{};
  std::condition_variable changed{};
  int made = 0;
  int frames = 0;
  int inside = 0;  ///< draw() calls in progress
  int max_inside = 0;
};

/// @param fails  whether the second instance fails
class RendezvousWorkload : public Workload {
 public:
  RendezvousWorkload(Rendezvous& rendezvous, const WorkloadSetup& setup, bool fails)
      : rendezvous_(rendezvous), fails_(fails && rendezvous.made == 1), picture_(1 + rendezvous.made, 1) {
    ++rendezvous_.made;
    EXPECT_EQ(setup.options.threads, 1);
  }
  FrameStats draw() override {
    if (fails_) throw Error("no frame");
    std::unique_lock lock(rendezvous_.mutex);
    ++rendezvous_.frames;
    rendezvous_.max_inside = std::max(rendezvous_.max_inside, ++rendezvous_.inside);
    rendezvous_.changed.notify_all();
    rendezvous_.changed.wait_for(lock, std::chrono::seconds(10), [&] { return rendezvous_.max_inside == 2; });
    --rendezvous_.inside;
    return {};
  }
  std::string fault() override { return fails_ ? "no picture" : ""; }
  const Picture& picture() override { return picture_; }
  FrameWork work(const FrameStats&) const override { return {.pixels = 7}; }

 private:
  Rendezvous& rendezvous_;
  bool fails_;
  Picture picture_;
};
WorkloadEntry rendezvous_entry(Rendezvous& rendezvous, bool fails) {
  return {.name = "rendezvous", .description = "", .make = [&rendezvous, fails](const WorkloadSetup& setup) {
            return std::make_unique<RendezvousWorkload>(rendezvous, setup, fails);
          }};
}

TEST(BenchIndependentRenderers, DrawsConcurrently) {
  const ThreadLimit limit(2);
  Rendezvous rendezvous;
  IndependentRenderers renderers(rendezvous_entry(rendezvous, false), {.options = {.threads = 8}});
  const FrameStats stats = renderers.draw();
  EXPECT_EQ(rendezvous.max_inside, 2);
  EXPECT_EQ(rendezvous.frames, 2 * IndependentRenderers::kFrames);
  EXPECT_EQ(renderers.fault(), "");
  EXPECT_EQ(renderers.work(stats).pixels, 7u);
  EXPECT_EQ(renderers.picture().width, 1) << "picture of the first one";
}

TEST(BenchIndependentRenderers, FailsIfOneFails) {
  const ThreadLimit limit(2);
  Rendezvous rendezvous{.max_inside = 2};
  IndependentRenderers renderers(rendezvous_entry(rendezvous, true), {});
  EXPECT_EQ(renderers.fault(), "no picture");
  EXPECT_THROW(renderers.draw(), Error);
}

// Six frames in the time of two.
TEST(BenchIndependentRenderers, SpeedUpCountsAllFrames) {
  const Ratio speed = IndependentRenderers::speed_up({.median = 2, .median_ci_low = 1, .median_ci_high = 4},
                                                     {.median = 4, .median_ci_low = 2, .median_ci_high = 4});
  EXPECT_DOUBLE_EQ(speed.value, 3);
  EXPECT_DOUBLE_EQ(speed.low, 1.5);
  EXPECT_DOUBLE_EQ(speed.high, 12);
}

}  // namespace
}  // namespace tessera::bench::independent_renderers_test
