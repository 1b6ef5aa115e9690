// Who draws how often and what becomes of what goes wrong, with workloads that only count.
#include "perf/bench/measure.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "perf/bench/bandwidth.h"
#include "perf/bench/rival_comparisons.h"

namespace tessera::bench {
namespace {

constexpr MeasureOptions kFewFrames{.repeats = 7, .seconds = 0.001, .warm_up_seconds = 0};

/// What is seen of workloads from outside: frames drawn by each, in their order, by its number.
struct Log {
  std::vector<int> frames;
  int alive = 0;
};

class Counting : public Workload {
 public:
  Counting(Log& log, int number, Picture picture, std::string fault, int fails_at, const FrameWork& work)
      : log_(log),
        number_(number),
        picture_(std::move(picture)),
        fault_(std::move(fault)),
        fails_at_(fails_at),
        work_(work) {
    ++log_.alive;
  }
  ~Counting() override { --log_.alive; }
  FrameStats draw() override {
    if (drawn_++ == fails_at_) throw std::bad_alloc();
    log_.frames.push_back(number_);
    return {};
  }
  std::string fault() override { return fault_; }
  const Picture& picture() override { return picture_; }
  FrameWork work(const FrameStats&) const override { return work_; }

 private:
  Log& log_;
  int number_;
  Picture picture_;
  std::string fault_;
  int fails_at_, drawn_ = 0;
  FrameWork work_;
};

Picture grey(std::uint8_t level) {
  Picture picture(10, 10);
  std::fill(picture.rgba.begin(), picture.rgba.end(), level);
  return picture;
}

struct Made {
  Picture picture = grey(100);
  std::string fault{};
  int fails_at = -1;  // the frame
  Roofline roofline = Roofline::none;
  std::uint64_t roofline_bytes = 1 << 20;
  std::uint64_t tile_bytes = 0;
};
Candidate counting(Log& log, int number, const Made& made = {}) {
  const FrameWork work{.pixels = 1,
                       .roofline = made.roofline,
                       .roofline_bytes = made.roofline_bytes,
                       .tile_bytes = made.tile_bytes};
  return {.name = "counting",
          .make =
              [=, &log] {
                return std::make_unique<Counting>(log, number, made.picture, made.fault, made.fails_at, work);
              },
          .threads = 1};
}

TEST(BenchMeasure, TakesTurnsAsOftenEach) {
  Log log;
  const std::vector<Row> rows = measure(std::vector{counting(log, 0), counting(log, 1), counting(log, 2)},
                                        kFewFrames, HardwareCounters());
  ASSERT_EQ(rows.size(), 3u);
  for (const Row& row : rows) {
    EXPECT_EQ(row.frames, 7u);
    EXPECT_EQ(row.fault, "");
  }
  EXPECT_EQ(log.alive, 0);
  EXPECT_EQ(std::vector(log.frames.begin(), log.frames.begin() + 3), (std::vector{0, 1, 2}))
      << "the first frames";
  // Then three each to be warm, and turns at random: whoever follows another draws one frame more.
  const std::vector<int> turns(log.frames.begin() + 3 + 3 * 3, log.frames.end());
  std::size_t changes = 1;
  for (std::size_t i = 1; i < turns.size(); ++i) changes += turns[i] != turns[i - 1] ? 1 : 0;
  EXPECT_EQ(turns.size(), 3 * 7 + changes);
  EXPECT_GT(changes, 6u) << "not one after the other";
}

TEST(BenchMeasure, WhatARowIsHeldAgainstTakesTurnsWithIt) {
  MeasureOptions options = kFewFrames;
  options.measures_rooflines = true;
  for (const Roofline roofline : {Roofline::l1_stores, Roofline::tile_stores, Roofline::memory_stores,
                                  Roofline::memory_copies, Roofline::memory_loads}) {
    Log log;
    const std::vector<Row> rows = measure(
        std::vector{counting(log, 0, {.roofline = roofline, .tile_bytes = 1 << 20}), counting(log, 1)},
        options, HardwareCounters());
    ASSERT_EQ(rows.size(), 2u);
    const double alone = measure_bandwidth(roofline, 1, 1 << 20);  // and on a busy machine
    EXPECT_GT(rows[0].roofline, alone / 30);
    EXPECT_LT(rows[0].roofline, alone * 30);
    EXPECT_EQ(rows[1].roofline, 0) << "there is none";
    for (const Row& row : rows) EXPECT_EQ(row.frames, 7u);
    // Of the two alone whoever follows the other draws a frame more; with the roofline some of those that
    // follow themselves do.
    const std::vector<int> turns(log.frames.begin() + 2 + 2 * 3, log.frames.end());
    std::size_t changes = 1;
    for (std::size_t i = 1; i < turns.size(); ++i) changes += turns[i] != turns[i - 1] ? 1 : 0;
    EXPECT_GT(turns.size(), 2 * 7 + changes) << "it stood between them";
    Log without;
    EXPECT_EQ(
        measure(std::vector{counting(without, 0, {.roofline = roofline})}, kFewFrames, HardwareCounters())[0]
            .roofline,
        0)
        << "nobody asked";
  }
}

TEST(BenchMeasure, WhatTilesStoreIsHeldAgainstTheFirstCacheToo) {
  MeasureOptions options = kFewFrames;
  options.measures_rooflines = true;
  Log log;
  const auto row_of = [&](std::uint64_t tile_bytes) {
    return measure(
        std::vector{counting(
            log, 0,
            {.roofline = Roofline::tile_stores, .roofline_bytes = 1 << 14, .tile_bytes = tile_bytes})},
        options, HardwareCounters())[0];
  };
  const Row small = row_of(1 << 14), large = row_of(1 << 26);
  for (const Row& row : {small, large}) {
    EXPECT_EQ(row.frames, 7u);
    EXPECT_GT(row.roofline, 0);
    EXPECT_GT(row.l1_stores, 0);
  }
#ifndef __SANITIZE_THREAD__  // what it notes of each byte takes as long, wherever that is
  EXPECT_LT(large.roofline, large.l1_stores / 2) << "no cache next to a core holds so much";
#endif
  const Row other = measure(std::vector{counting(log, 0, {.roofline = Roofline::memory_stores})}, options,
                            HardwareCounters())[0];
  EXPECT_EQ(other.l1_stores, 0) << "it is not for tiles";
}

TEST(BenchMeasure, FramesFillTheirSecondsWhateverTheirLimitTakes) {
  // A run of stores in L1 takes far longer than the 15th part of these seconds, a frame that only counts far
  // less.
  Log log;
  const std::vector<Row> rows =
      measure(std::vector{counting(log, 0, {.roofline = Roofline::l1_stores})},
              {.seconds = 0.01, .warm_up_seconds = 0, .measures_rooflines = true}, HardwareCounters());
  EXPECT_GT(rows[0].frames, 15u);
  EXPECT_GT(rows[0].roofline, 0);
}

#if !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)  // the sanitizer's allocator ends the program instead
TEST(BenchMeasure, ARowIsTimedThoughThereIsNoMemoryForItsLimit) {
  Log log;
  for (const Roofline roofline : {Roofline::memory_stores, Roofline::memory_copies}) {
    MeasureOptions options = kFewFrames;
    options.measures_rooflines = true;
    const std::vector<Row> rows = measure(
        std::vector{counting(log, 0, {.roofline = roofline, .roofline_bytes = std::uint64_t{1} << 60})},
        options, HardwareCounters());
    EXPECT_EQ(rows[0].fault, "");
    EXPECT_EQ(rows[0].frames, 7u);
    EXPECT_EQ(rows[0].roofline, 0);
  }
}
#endif

TEST(BenchBandwidth, CountWhatTheyMove) {
  EXPECT_EQ(BandwidthKernel(Roofline::memory_stores, 2, 1000, 1000).bytes(), 1000);
  EXPECT_EQ(BandwidthKernel(Roofline::memory_loads, 1, 1000, 2000).bytes(), 2000);
  EXPECT_EQ(BandwidthKernel(Roofline::memory_copies, 2, 4000, 12000).bytes(), 12000)
      << "half of them are read";
  EXPECT_EQ(BandwidthKernel(Roofline::memory_copies, 8, 4, 4).bytes(), 16) << "each thread something";
  EXPECT_EQ(BandwidthKernel(Roofline::memory_stores, 2, 5000, 12000).bytes(), 10000) << "whole memories";
  EXPECT_EQ(BandwidthKernel(Roofline::memory_copies, 2, 5000, 1000).bytes(), 5000) << "once";
  EXPECT_EQ(BandwidthKernel(Roofline::memory_stores, 1, 16, 64 << 20).bytes(), 16e6)
      << "a million times, and no more";
  EXPECT_EQ(BandwidthKernel(Roofline::l1_stores, 3, 5000, 1000).bytes(), 20000.0 * 3 * 16384)
      << "the first caches', whatever the frame";
}

TEST(BenchBandwidth, AreTheFramesOwn) {
  EXPECT_EQ(bandwidth_kernel_for(
                {.roofline = Roofline::memory_stores, .roofline_bytes = 1000, .tile_bytes = 8}, 2, 1)
                .bytes(),
            1000);
  EXPECT_EQ(
      bandwidth_kernel_for({.roofline = Roofline::tile_stores, .roofline_bytes = 8, .tile_bytes = 1000}, 2, 1)
          .bytes(),
      2000)
      << "a tile for each thread";
  EXPECT_EQ(
      bandwidth_kernel_for({.roofline = Roofline::l1_stores, .roofline_bytes = 8, .tile_bytes = 8}, 1, 1)
          .bytes(),
      20000.0 * 16384);
}

TEST(BenchMeasure, DoesNotTimeWhatIsWrong) {
  Log log;
  const std::vector<Row> rows =
      measure(std::vector{counting(log, 0), counting(log, 1, {.fault = "a pixel is off"})}, kFewFrames,
              HardwareCounters());
  EXPECT_EQ(rows[0].fault, "");
  EXPECT_EQ(rows[1].fault, "a pixel is off");
  EXPECT_FALSE(rows[1].is_aborted);
  for (const Row& row : rows) EXPECT_EQ(row.frames, 0u);
  EXPECT_EQ(log.frames.size(), 2u);
}

TEST(BenchMeasure, WhatStopsAWorkloadIsAFaultOfItsRow) {
  for (const int frame : {0, 2, 6}) {  // the first, of the warm-up, of those that are timed
    Log log;
    const std::vector<Row> rows =
        measure(std::vector{counting(log, 0, {.fails_at = frame})}, kFewFrames, HardwareCounters());
    EXPECT_EQ(rows[0].fault, "out of memory") << frame;
    EXPECT_TRUE(rows[0].is_aborted) << frame;
    EXPECT_EQ(rows[0].frames, 0u) << frame;
    EXPECT_EQ(log.alive, 0) << frame;
  }
  // Of several it is the fault of the one whose turn it was.
  for (const int frame : {0, 2, 6}) {
    Log log;
    const std::vector<Row> rows = measure(
        std::vector{counting(log, 0), counting(log, 1, {.fails_at = frame})}, kFewFrames, HardwareCounters());
    EXPECT_EQ(rows[0].fault, "") << frame;
    EXPECT_EQ(rows[1].fault, "out of memory") << frame;
    for (const Row& row : rows) EXPECT_EQ(row.frames, 0u) << frame;
  }
  Candidate unmade{.name = "unmade",
                   .make = []() -> std::unique_ptr<Workload> { throw Error("no such mesh"); },
                   .threads = 1};
  EXPECT_EQ(measure(std::vector{unmade}, kFewFrames, HardwareCounters())[0].fault, "no such mesh");
}

TEST(BenchComparison, IsFoughtOverTheSamePicture) {
  Log log;
  Made off;
  for (std::size_t i = 0; i < 5; ++i) off.picture.rgba[4 * i + i % 3] = 103;  // five pixels of a hundred
  off.picture.rgba[400 - 4] = 102;                                            // two levels are none
  off.picture.rgba[400 - 5] = 0;                                              // nor is alpha
  const Comparison even =
      compare_with_rival(counting(log, 0), counting(log, 1, off), 0.05, kFewFrames, HardwareCounters());
  EXPECT_EQ(even.fault(), "");
  EXPECT_DOUBLE_EQ(even.mismatch_share, 0.05);
  EXPECT_EQ(even.ours.frames, 7u);
  EXPECT_EQ(even.rivals.frames, 7u);
  const Comparison odd =
      compare_with_rival(counting(log, 0), counting(log, 1, off), 0.049, kFewFrames, HardwareCounters());
  EXPECT_EQ(odd.fault(),
            "the rival's picture differs by more than two levels in 5.000 % of the pixels, expected 4.900 % "
            "at most");
  EXPECT_EQ(odd.ours.frames, 0u);
}

TEST(BenchComparison, SaysWhoIsWrong) {
  Log log;
  EXPECT_EQ(compare_with_rival(counting(log, 0, {.fault = "ours"}), counting(log, 1), 1, kFewFrames,
                               HardwareCounters())
                .fault(),
            "ours");
  EXPECT_EQ(compare_with_rival(counting(log, 0), counting(log, 1, {.fault = "the rival's"}), 1, kFewFrames,
                               HardwareCounters())
                .fault(),
            "the rival's");
  EXPECT_EQ(compare_with_rival(counting(log, 0), counting(log, 1, {.picture = Picture(10, 9)}), 1, kFewFrames,
                               HardwareCounters())
                .fault(),
            "the rival's picture has another size");
}

}  // namespace
}  // namespace tessera::bench
