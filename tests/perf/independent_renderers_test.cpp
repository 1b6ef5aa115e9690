// Two workloads at once, which wait for each other to be sure of it.
#include "perf/bench/independent_renderers.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>

#include <gtest/gtest.h>

namespace tessera::bench {
using namespace program;
namespace {

struct Meeting {
  std::mutex mutex{};
  std::condition_variable changed{};
  int made = 0, frames = 0, inside = 0, most_inside = 0;
};

/// The second one that is made may fail.
class Meets : public Workload {
 public:
  Meets(Meeting& meeting, const WorkloadSetup& setup, bool fails)
      : meeting_(meeting), fails_(fails && meeting.made == 1), picture_(1 + meeting.made, 1) {
    ++meeting_.made;
    EXPECT_EQ(setup.options.threads, 1);
  }
  FrameStats draw() override {
    if (fails_) throw Error("no frame");
    std::unique_lock lock(meeting_.mutex);
    ++meeting_.frames;
    meeting_.most_inside = std::max(meeting_.most_inside, ++meeting_.inside);
    meeting_.changed.notify_all();
    meeting_.changed.wait_for(lock, std::chrono::seconds(10), [&] { return meeting_.most_inside == 2; });
    --meeting_.inside;
    return {};
  }
  std::string fault() override { return fails_ ? "no picture" : ""; }
  const Picture& picture() override { return picture_; }
  FrameWork work(const FrameStats&) const override { return {.pixels = 7}; }

 private:
  Meeting& meeting_;
  bool fails_;
  Picture picture_;
};
WorkloadEntry meets(Meeting& meeting, bool fails) {
  return {.name = "meets", .what = "", .make = [&meeting, fails](const WorkloadSetup& setup) {
            return std::make_unique<Meets>(meeting, setup, fails);
          }};
}

TEST(IndependentRenderers, DrawAtOnce) {
  const ThreadLimit limit(2);
  Meeting meeting;
  IndependentRenderers apart(meets(meeting, false), {.options = {.threads = 8}});
  const FrameStats stats = apart.draw();
  EXPECT_EQ(meeting.most_inside, 2);
  EXPECT_EQ(meeting.frames, 2 * IndependentRenderers::kFrames);
  EXPECT_EQ(apart.fault(), "");
  EXPECT_EQ(apart.work(stats).pixels, 7u);
  EXPECT_EQ(apart.picture().width, 1) << "the first one's";
}

TEST(IndependentRenderers, FailIfOneDoes) {
  const ThreadLimit limit(2);
  Meeting meeting{.most_inside = 2};
  IndependentRenderers apart(meets(meeting, true), {});
  EXPECT_EQ(apart.fault(), "no picture");
  EXPECT_THROW(apart.draw(), Error);
}

// Six frames in the time of two.
TEST(IndependentRenderers, AreThreeTimesAsFastIfTheirFramesTakeTheTimeOfTwo) {
  const Ratio speed = IndependentRenderers::speed_up({.median = 2, .median_ci_low = 1, .median_ci_high = 4},
                                                     {.median = 4, .median_ci_low = 2, .median_ci_high = 4});
  EXPECT_DOUBLE_EQ(speed.value, 3);
  EXPECT_DOUBLE_EQ(speed.low, 1.5);
  EXPECT_DOUBLE_EQ(speed.high, 12);
}

}  // namespace
}  // namespace tessera::bench
