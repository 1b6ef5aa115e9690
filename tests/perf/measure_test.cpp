// Order and number of turns, and handling of faults, with workloads that only count their frames.
#include "perf/bench/measure.h"

#include <algorithm>
#include <chrono>

#include <gtest/gtest.h>

#include "perf/bench/bandwidth.h"
#include "perf/bench/reference_work.h"
#include "perf/bench/rival_comparisons.h"

namespace tessera::bench::measure_test {
namespace {

constexpr MeasureOptions kFewFrames{.repeats = 7, .seconds = 0.001, .warm_up_seconds = 0};

struct Log {
  std::vector<int> frames;  ///< number of the workload that drew each frame
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
  int fails_at_;
  int drawn_ = 0;
  FrameWork work_;
};

Picture gray(std::uint8_t level) {
  Picture picture(10, 10);
  std::fill(picture.rgba.begin(), picture.rgba.end(), level);
  return picture;
}

struct Made {
  Picture picture = gray(100);
  std::string fault{};
  int fails_at = -1;  // index of the frame that throws
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

TEST(BenchMeasure, GivesEachCandidateEqualTurns) {
  Log log;
  const std::vector<Row> rows = measure(std::vector{counting(log, 0), counting(log, 1), counting(log, 2)},
                                        kFewFrames, HardwareCounters());
  ASSERT_EQ(rows.size(), 3u);
  for (const Row& row : rows) {
    EXPECT_EQ(row.frames, 7u);
    EXPECT_EQ(row.fault, "");
  }
  EXPECT_EQ(log.alive, 0);
  EXPECT_EQ(std::vector(log.frames.begin(), log.frames.begin() + 3), (std::vector{0, 1, 2})) << "cold frames";
  // Then three warm-up frames each, and random turns: one more frame after each change of candidate.
  const std::vector<int> turns(log.frames.begin() + 3 + 3 * 3, log.frames.end());
  std::size_t changes = 1;
  for (std::size_t i = 1; i < turns.size(); ++i) changes += turns[i] != turns[i - 1] ? 1 : 0;
  EXPECT_EQ(turns.size(), 3 * 7 + changes);
  EXPECT_GT(changes, 6u) << "turns are interleaved";
}

TEST(BenchMeasure, MeasuresRooflinesInTurnsWithTheirRow) {
  MeasureOptions options = kFewFrames;
  options.measures_rooflines = true;
  for (const Roofline roofline : {Roofline::l1_stores, Roofline::tile_stores, Roofline::memory_stores,
                                  Roofline::memory_copies, Roofline::memory_loads}) {
    Log log;
    const std::vector<Row> rows = measure(
        std::vector{counting(log, 0, {.roofline = roofline, .tile_bytes = 1 << 20}), counting(log, 1)},
        options, HardwareCounters());
    ASSERT_EQ(rows.size(), 2u);
    const double alone = measure_bandwidth(roofline, 1, 1 << 20, 0.2);
    EXPECT_GT(rows[0].roofline, alone / 30) << "also on a busy machine";
    EXPECT_LT(rows[0].roofline, alone * 30) << "also on a busy machine";
    EXPECT_EQ(rows[1].roofline, 0) << "it has no roofline";
    for (const Row& row : rows) EXPECT_EQ(row.frames, 7u);
    // Without a roofline, one more frame is drawn after each change between the two. With it, some turns of
    // the same workload are separated by the roofline's.
    const std::vector<int> turns(log.frames.begin() + 2 + 2 * 3, log.frames.end());
    std::size_t changes = 1;
    for (std::size_t i = 1; i < turns.size(); ++i) changes += turns[i] != turns[i - 1] ? 1 : 0;
    EXPECT_GT(turns.size(), 2 * 7 + changes);
    Log without;
    EXPECT_EQ(
        measure(std::vector{counting(without, 0, {.roofline = roofline})}, kFewFrames, HardwareCounters())[0]
            .roofline,
        0)
        << "measures_rooflines is false";
  }
}

TEST(BenchMeasure, ComparesTileStoresWithL1StoresToo) {
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
  const Row small = row_of(1 << 14);
  const Row large = row_of(1 << 26);
  for (const Row& row : {small, large}) {
    EXPECT_EQ(row.frames, 7u);
    EXPECT_GT(row.roofline, 0);
    EXPECT_GT(row.l1_stores, 0);
  }
#ifndef __SANITIZE_THREAD__  // its bookkeeping dominates, wherever the bytes are
  EXPECT_LT(large.roofline, large.l1_stores / 2) << "64 MiB exceed the caches of a core";
#endif
  const Row other = measure(std::vector{counting(log, 0, {.roofline = Roofline::memory_stores})}, options,
                            HardwareCounters())[0];
  EXPECT_EQ(other.l1_stores, 0) << "the roofline is not tile_stores";
}

TEST(BenchMeasure, TimesTheReferenceWorkInTurnsWithFrames) {
  Log log;
  MeasureOptions options = kFewFrames;
  options.measures_reference = true;
  const Row row = measure(std::vector{counting(log, 0)}, options, HardwareCounters())[0];
  EXPECT_EQ(row.fault, "");
  EXPECT_EQ(row.frames, 7u);
  EXPECT_GT(row.reference_ms, 0);
  EXPECT_LT(row.reference_ms, 100) << "a unit is some 60 us of arithmetic";
  // Some turns of the workload are separated by the reference's: one more frame is drawn after each.
  EXPECT_GT(log.frames.size(), 1u + 3 + 7 + 1);
  EXPECT_EQ(measure(std::vector{counting(log, 0)}, kFewFrames, HardwareCounters())[0].reference_ms, 0);
}

TEST(BenchReferenceWork, HasUnitsForTheGivenTime) {
  EXPECT_EQ(ReferenceWork(3, 1e-9).units(), 3u) << "at least one per thread";
  const std::size_t one = ReferenceWork(1, 0.1).units();
  EXPECT_GT(one, 10u);
  ReferenceWork work(1, 0.1);
  const auto start = std::chrono::steady_clock::now();
  work.run();
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  EXPECT_GT(seconds, 0.02) << "the compiler removed the work";
}

TEST(BenchMeasure, SlowRooflineDoesNotReduceFrames) {
  // One run of the L1 stores takes far longer than 1/15 of these seconds, a frame of this workload far less.
  Log log;
  const std::vector<Row> rows =
      measure(std::vector{counting(log, 0, {.roofline = Roofline::l1_stores})},
              {.seconds = 0.01, .warm_up_seconds = 0, .measures_rooflines = true}, HardwareCounters());
  EXPECT_GT(rows[0].frames, 15u);
  EXPECT_GT(rows[0].roofline, 0);
}

// The allocators of these sanitizers abort the program instead of throwing.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
TEST(BenchMeasure, TimesRowWithoutMemoryForItsRoofline) {
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

TEST(BenchBandwidth, CountsMovedBytes) {
  EXPECT_EQ(BandwidthKernel(Roofline::memory_stores, 2, 1000, 1000).bytes(), 1000);
  EXPECT_EQ(BandwidthKernel(Roofline::memory_loads, 1, 1000, 2000).bytes(), 2000);
  EXPECT_EQ(BandwidthKernel(Roofline::memory_copies, 2, 4000, 12000).bytes(), 12000)
      << "reads and writes count";
  EXPECT_EQ(BandwidthKernel(Roofline::memory_copies, 8, 4, 4).bytes(), 16) << "at least one byte per thread";
  EXPECT_EQ(BandwidthKernel(Roofline::memory_stores, 2, 5000, 12000).bytes(), 10000) << "whole passes only";
  EXPECT_EQ(BandwidthKernel(Roofline::memory_copies, 2, 5000, 1000).bytes(), 5000) << "at least one pass";
  EXPECT_EQ(BandwidthKernel(Roofline::memory_stores, 1, 16, 64 << 20).bytes(), 16e6)
      << "at most a million passes";
  EXPECT_EQ(BandwidthKernel(Roofline::l1_stores, 3, 5000, 1000).bytes(), 20000.0 * 3 * 16384)
      << "independent of the size of the frame";
}

TEST(BenchBandwidth, MatchesTheFramesRoofline) {
  EXPECT_EQ(bandwidth_kernel_for(
                {.roofline = Roofline::memory_stores, .roofline_bytes = 1000, .tile_bytes = 8}, 2, 1)
                .bytes(),
            1000);
  EXPECT_EQ(
      bandwidth_kernel_for({.roofline = Roofline::tile_stores, .roofline_bytes = 8, .tile_bytes = 1000}, 2, 1)
          .bytes(),
      2000)
      << "one tile per thread";
  EXPECT_EQ(
      bandwidth_kernel_for({.roofline = Roofline::l1_stores, .roofline_bytes = 8, .tile_bytes = 8}, 1, 1)
          .bytes(),
      20000.0 * 16384);
}

TEST(BenchMeasure, DoesNotTimeWrongPictures) {
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

TEST(BenchMeasure, ReportsExceptionsAsFaultOfTheRow) {
  for (const int frame : {0, 2, 6}) {  // cold, warm-up and timed frame
    Log log;
    const std::vector<Row> rows =
        measure(std::vector{counting(log, 0, {.fails_at = frame})}, kFewFrames, HardwareCounters());
    EXPECT_EQ(rows[0].fault, "out of memory") << frame;
    EXPECT_TRUE(rows[0].is_aborted) << frame;
    EXPECT_EQ(rows[0].frames, 0u) << frame;
    EXPECT_EQ(log.alive, 0) << frame;
  }
  // The candidate whose turn it was has the fault.
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

TEST(BenchComparison, RequiresMatchingPictures) {
  Log log;
  Made off;
  for (std::size_t i = 0; i < 5; ++i) off.picture.rgba[4 * i + i % 3] = 103;  // five pixels of a hundred
  off.picture.rgba[400 - 4] = 102;                                            // two levels are allowed
  off.picture.rgba[400 - 5] = 0;                                              // alpha is ignored
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

TEST(BenchComparison, NamesTheFaultySide) {
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
            "the rival's picture is 10x9, expected 10x10");
}

}  // namespace
}  // namespace tessera::bench::measure_test
