// Prices: names, mixtures of triangle sizes, and the time that follows from counts.
#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>

#include "tests/engine/frame/api_support.h"

namespace tessera::prices_test {
namespace {

constexpr PriceItem item_at(std::size_t i) { return static_cast<PriceItem>(i); }

TEST(Prices, HaveDistinctCodesAndUnits) {
  std::set<std::string_view> codes;
  for (std::size_t i = 0; i < kPriceItems; ++i) {
    EXPECT_FALSE(code(item_at(i)).empty()) << i;
    EXPECT_FALSE(name(unit(item_at(i))).empty()) << i;
    codes.insert(code(item_at(i)));
  }
  EXPECT_EQ(codes.size(), kPriceItems);
  EXPECT_EQ(code(item_at(kPriceItems)), "");
}

TEST(Prices, AddUpToTheTimeOfAFrame) {
  PriceList prices;
  prices[PriceItem::frame] = {.nanoseconds = 1000};
  prices[PriceItem::draw] = {.nanoseconds = 200};
  prices[PriceItem::vertex] = {.nanoseconds = 5};
  prices[PriceItem::pixel_spot] = {.nanoseconds = 0.5};
  WorkCounts counts;
  counts[PriceItem::frame] = 1;
  counts[PriceItem::draw] = 10;
  counts[PriceItem::vertex] = 600;
  counts[PriceItem::pixel_spot] = 2000;
  EXPECT_DOUBLE_EQ(predicted_seconds(counts, prices, 1), 7000e-9);
  EXPECT_DOUBLE_EQ(predicted_seconds(counts, prices, 4), 4000e-9) << "frames and draws count on one thread";
  EXPECT_EQ(test::error_of([&] { predicted_seconds(counts, prices, 0); }),
            "predicted_seconds: threads: found 0, expected at least 1");
}

/// Sizes of the items that are triangles of a size.
std::map<PriceItem, double> sizes() {
  std::map<PriceItem, double> list;
  for (std::size_t i = 0; i < kPriceItems; ++i)
    if (is_triangle_size(item_at(i)))
      list[item_at(i)] = std::stod(std::string(code(item_at(i)).substr(std::string("triangle_").size())));
  return list;
}

// A mixture has as many triangles and pixels as the triangles that it stands for.
TEST(Prices, MixTrianglesWithoutLosingAny) {
  ASSERT_EQ(sizes().size(), 8u);
  for (const double mean : {0.0, 0.3, 1.0, 2.5, 4.0, 100.0, 4096.0, 500000.0}) {
    WorkCounts counts;
    add_triangles(counts, 60, 60 * mean);
    double triangles = 0, pixels = 0;
    int used = 0;
    for (const auto& [item, size] : sizes()) {
      triangles += counts[item];
      pixels += counts[item] * size;
      used += counts[item] != 0 ? 1 : 0;
    }
    EXPECT_NEAR(triangles, 60, 1e-9) << mean;
    EXPECT_NEAR(pixels, 60 * mean, 1e-6) << mean;
    EXPECT_LE(used, 2) << mean;
  }
  WorkCounts exact;
  add_triangles(exact, 3, 48);
  EXPECT_DOUBLE_EQ(exact[PriceItem::triangle_16], 3);
  WorkCounts none;
  add_triangles(none, 0, 0);
  EXPECT_DOUBLE_EQ(none[PriceItem::triangle_0], 0);
}

}  // namespace
}  // namespace tessera::prices_test
