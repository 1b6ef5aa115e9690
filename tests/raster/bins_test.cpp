// Bins that share a memory budget, and batches of bins.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "raster/bins.h"

namespace tessera::test::bins_test {
using namespace detail;
namespace {

TEST(Bins, StayWithinBudgetAndCountLostEntries) {
  std::mt19937 random(4);
  for (const std::size_t limit : {std::size_t{20000}, std::size_t{100000}, std::size_t{4} << 20}) {
    BinBudget budget(limit);
    std::vector<Bins> bins(3), unlimited(3);
    for (Bins& each : bins) each.reset(50, 100, &budget);
    for (Bins& each : unlimited) each.reset(50, 100);
    bool any_overflow = false;
    for (int i = 0; i < 60000; ++i) {
      const std::size_t b = random() % 3;
      const std::uint32_t draw = static_cast<std::uint32_t>(i / 1000);
      const int tile = 100 + static_cast<int>(random() % 50);
      for (Bins* const to : {&bins[b], &unlimited[b]}) {
        std::uint32_t id = static_cast<std::uint32_t>(i);
        if (i % 9 == 0) {
          DerivedPrimitive& derived = to->add_derived(id, 3, 8);
          std::fill_n(to->attributes(derived), 24, static_cast<float>(i));
          id = to->last_derived_id();
          if (i % 2 == 0) to->drop_last_derived();
        }
        if (i % 18 != 0) to->push(tile, draw, id);
      }
      std::size_t bytes = 0;
      for (const Bins& each : bins) bytes += each.bytes();
      ASSERT_LE(bytes, limit + 3 * (sizeof(Bins::Block) + 256))
          << "budget exceeded by more than the block and the padding that remain after an overflow";
    }
    std::size_t bytes = 0;
    for (const Bins& each : bins) bytes += each.bytes();
    EXPECT_TRUE(bytes >= limit || budget.take(limit - bytes))
        << "replaced memory was not returned to the budget";
    for (std::size_t b = 0; b < 3; ++b) {
      any_overflow |= bins[b].overflowed();
      EXPECT_EQ(bins[b].counts.entries, unlimited[b].counts.entries);
      if (bins[b].overflowed()) continue;
      for (int tile = 100; tile < 150; ++tile) {
        ASSERT_EQ(bins[b].element_count(tile), unlimited[b].element_count(tile));
        std::uint32_t i = bins[b].first(tile), j = unlimited[b].first(tile);
        for (; i != Bins::kNone && j != Bins::kNone;
             i = bins[b].block(i).next, j = unlimited[b].block(j).next)
          ASSERT_TRUE(std::equal(bins[b].block(i).entries, bins[b].block(i).entries + bins[b].block(i).count,
                                 unlimited[b].block(j).entries));
        ASSERT_EQ(i, j);
      }
    }
    EXPECT_EQ(any_overflow, limit < 1000000);
  }
}

TEST(Bins, AreEmptyAfterResetAndReportTheirMemory) {
  std::mt19937 random(9);
  Bins bins;
  int overflow_count = 0;
  for (int round = 0; round < 60; ++round) {
    const int tiles = round % 5 == 4 ? 70 : 40, pushes = static_cast<int>(random() % 30000);
    const bool overflows = round % 3 == 2;
    if (overflows) bins = Bins();
    const std::size_t limit = overflows ? 60000 : 10000000;
    BinBudget budget;
    budget.start(limit, bins.bytes());
    bins.reset(tiles, round, &budget);
    for (int tile = round; tile < round + tiles; ++tile)
      ASSERT_TRUE(bins.first(tile) == Bins::kNone && bins.element_count(tile) == 0) << round;
    std::vector<std::uint32_t> expected(static_cast<std::size_t>(tiles));
    for (int i = 0; i < pushes; ++i) {
      const int span = 1 + round % tiles;
      // In overflow rounds tiles ascend, so that some get their first entry after the overflow.
      const auto tile = static_cast<std::size_t>(overflows ? i * span / pushes
                                                           : static_cast<int>(random() % 1000) * span / 1000);
      bins.push(round + static_cast<int>(tile), 1, static_cast<std::uint32_t>(i));
      ++expected[tile];
    }
    ASSERT_EQ(bins.overflowed(), budget.refused());
    if (bins.overflowed()) ++overflow_count;
    if (bins.overflowed()) continue;
    ASSERT_TRUE(std::equal(expected.begin(), expected.end(), bins.element_counts_from(round)));
    for (int t = 0; t < tiles; ++t) {
      const std::uint32_t first = bins.first(round + t);
      ASSERT_EQ(first == Bins::kNone, expected[static_cast<std::size_t>(t)] == 0);
      if (first != Bins::kNone) {
        ASSERT_EQ(bins.block(first).entries[0], kDrawMarker | 1);
      }
    }
    EXPECT_TRUE(budget.take(limit - bins.bytes())) << "the budget was charged more than bytes()";
    EXPECT_FALSE(budget.take(1)) << "the budget was charged less than bytes()";
  }
  EXPECT_GT(overflow_count, 10);
}

/// The batches that a reader of `tile` visits.
std::vector<std::uint32_t> read_by(const BinBatches& batches, int tile) {
  std::vector<std::uint32_t> read;
  for (std::uint32_t b = batches.next(tile, 0); b < batches.count(); b = batches.next(tile, b + 1))
    read.push_back(b);
  return read;
}

TEST(BinBatches, TilesReadNonEmptyBatchesInOrder) {
  std::mt19937 random(5);
  constexpr int kFirst = 30, kTiles = 12;
  BinBatches batches;
  for (const std::size_t count : {1, 2, 63, 64, 65, 128, 200}) {
    for (const std::uint32_t one_of : {1u, 3u, 100u, 100000u}) {
      std::vector<Bins> bins(count);
      std::vector<std::uint32_t> expected[kTiles];
      std::uint64_t triangles[kTiles] = {};
      for (std::uint32_t b = 0; b < count; ++b) {
        bins[b].reset(kTiles, kFirst);
        for (int t = 0; t < kTiles; ++t) {
          if (random() % one_of != 0) continue;
          expected[t].push_back(b);
          const std::uint32_t pushed = random() % 4;
          for (std::uint32_t i = 0; i < pushed; ++i) bins[b].push(kFirst + t, 0, i);
          if (pushed == 0) bins[b].push_draw(kFirst + t, 1);
          triangles[t] += std::max(pushed, 1u);
        }
      }
      batches.set(bins, kTiles, kFirst);
      for (int t = 0; t < kTiles; t += 5) batches.index_batches(kFirst + t, std::min(5, kTiles - t));
      for (int t = 0; t < kTiles; ++t) {
        EXPECT_EQ(batches.element_count(kFirst + t), triangles[t]);
        EXPECT_EQ(read_by(batches, kFirst + t), expected[t]) << count;
        EXPECT_EQ(batches.known_empty(kFirst + t), expected[t].empty());
      }
      for (std::uint32_t b = 0; b < count; ++b) EXPECT_EQ(batches.peek(b), &batches.read(b));
      EXPECT_EQ(batches.peek(static_cast<std::uint32_t>(count)), nullptr);
    }
  }
}

TEST(BinBatches, StreamedBatchesAreAllRead) {
  Bins place;
  std::vector<std::uint32_t> filled;
  BinBatches batches;
  batches.set_streamed(place, 70, [&](std::uint32_t b) { filled.push_back(b); });
  batches.index_batches(7, 1);
  EXPECT_EQ(batches.element_count(7), 0);
  EXPECT_FALSE(batches.known_empty(7)) << "streamed batches are not indexed";
  const std::vector<std::uint32_t> read = read_by(batches, 7);
  ASSERT_EQ(read.size(), 70);
  EXPECT_EQ(batches.peek(0), nullptr) << "it would replace the batch read before";
  for (std::uint32_t b = 0; b < 70; ++b) {
    EXPECT_EQ(read[b], b);
    EXPECT_EQ(&batches.read(b), &place);
  }
  EXPECT_EQ(filled, read);
}

}  // namespace
}  // namespace tessera::test::bins_test
