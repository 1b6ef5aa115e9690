// Bins that share a budget of memory.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "raster/bins.h"

namespace tessera::test {
namespace {

TEST(Bins, StayWithinTheBudgetAndCountWhatTheyLose) {
  std::mt19937 random(4);
  for (const std::size_t limit : {std::size_t{20000}, std::size_t{100000}, std::size_t{4} << 20}) {
    BinBudget budget(limit);
    std::vector<Bins> bins(3), unlimited(3);
    for (int b = 0; b < 3; ++b) bins[static_cast<std::size_t>(b)].reset(50, 100, &budget), unlimited[static_cast<std::size_t>(b)].reset(50, 100);
    bool any_overflow = false;
    for (int i = 0; i < 60000; ++i) {
      const std::size_t b = random() % 3;
      const std::uint32_t draw = static_cast<std::uint32_t>(i / 1000);
      const int tile = 100 + static_cast<int>(random() % 50);
      for (Bins* const to : {&bins[b], &unlimited[b]}) {
        std::uint32_t id = static_cast<std::uint32_t>(i);
        if (i % 9 == 0) {
          Piece& piece = to->add_piece(id, 3, 8);
          std::fill_n(to->attributes(piece), 24, static_cast<float>(i));
          id = to->id_of_last_piece();
          if (i % 2 == 0) to->drop_last_piece();
        }
        if (i % 18 != 0) to->push(tile, draw, id);
      }
      std::size_t bytes = 0;
      for (const Bins& each : bins) bytes += each.bytes();
      ASSERT_LE(bytes, limit + 3 * (sizeof(Bins::Block) + 256)) << "but for the block and the padding that are left after an overflow";
    }
    std::size_t bytes = 0;
    for (const Bins& each : bins) bytes += each.bytes();
    EXPECT_TRUE(bytes >= limit || budget.take(limit - bytes)) << "memory that was grown out of was not given back";
    for (std::size_t b = 0; b < 3; ++b) {
      any_overflow |= bins[b].overflowed();
      EXPECT_EQ(bins[b].counts.entries, unlimited[b].counts.entries);
      if (bins[b].overflowed()) continue;
      for (int tile = 100; tile < 150; ++tile) {
        ASSERT_EQ(bins[b].triangles(tile), unlimited[b].triangles(tile));
        std::uint32_t i = bins[b].first(tile), j = unlimited[b].first(tile);
        for (; i != Bins::kNone && j != Bins::kNone; i = bins[b].block(i).next, j = unlimited[b].block(j).next)
          ASSERT_TRUE(std::equal(bins[b].block(i).entries, bins[b].block(i).entries + bins[b].block(i).count, unlimited[b].block(j).entries));
        ASSERT_EQ(i, j);
      }
    }
    EXPECT_EQ(any_overflow, limit < 1000000);
  }
}

}  // namespace
}  // namespace tessera::test
