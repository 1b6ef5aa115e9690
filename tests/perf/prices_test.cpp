// `tessera price`: the pairs of frames, the measurement, and the file of a price list.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <set>
#include <string>

#include "perf/prices/measure_prices.h"
#include "perf/prices/price_check.h"
#include "perf/prices/price_file.h"
#include "perf/prices/price_pairs.h"

namespace tessera::bench::prices_test {
namespace {

using testing::HasSubstr;

/// Sets a variable of the environment while it lives.
class Variable {
 public:
  Variable(const char* name, const std::string& value) : name_(name) {
    if (const char* const old = std::getenv(name)) old_ = old;
    ::setenv(name, value.c_str(), 1);
  }
  ~Variable() {
    if (old_) ::setenv(name_, old_->c_str(), 1);
    else ::unsetenv(name_);
  }

 private:
  const char* name_;
  std::optional<std::string> old_;
};

PriceList example_list() {
  PriceList list = empty_price_list(available_instruction_sets().front());
  for (std::size_t i = 0; i < kPriceItems; ++i)
    list.prices[i] = {0.1 * static_cast<double>(i), -1.0 / 3, static_cast<double>(i)};
  return list;
}

std::string error_of_parsing(const std::string& text) {
  try {
    parse_prices(text, "prices.json");
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(PricePairs, MeasureEveryItemOnceAfterTheItemsThatTheyUse) {
  std::set<PriceItem> seen;
  for (const PricePair& pair : price_pairs()) {
    for (const PriceItem item : pair.known) EXPECT_TRUE(seen.contains(item)) << code(pair.item);
    for (const PriceItem item : pair.instead) EXPECT_TRUE(seen.contains(item)) << code(pair.item);
    if (pair.has_known_triangles) {
      EXPECT_TRUE(seen.contains(PriceItem::triangle_4096)) << code(pair.item);
    }
    EXPECT_TRUE(seen.insert(pair.item).second) << code(pair.item);
  }
  EXPECT_EQ(seen.size(), kPriceItems);
}

// A pair whose frames have the same number of units, or none, would divide by zero.
TEST(PricePairs, HaveUnits) {
  for (const PricePair& pair : price_pairs()) {
    const UnitCounts with = units_of(pair.with);
    const auto index = static_cast<std::size_t>(unit(pair.item));
    EXPECT_GT(with[index], 0) << code(pair.item);
    if (pair.without) {
      EXPECT_GE(with[index], units_of(*pair.without)[index]) << code(pair.item);
    }
  }
}

TEST(PriceFrames, CoverTheWindowOnce) {
  PriceFrame frame;
  frame.format.width = 200;
  frame.format.height = 150;
  for (const double size : {4.0, 100.0, 4096.0}) {
    frame.triangle_pixels = size;
    const UnitCounts units = units_of(frame);
    const double pixels = units[static_cast<std::size_t>(PriceUnit::covered_pixel)];
    EXPECT_EQ(pixels, 200 * 150) << size;
    EXPECT_NEAR(pixels / units[static_cast<std::size_t>(PriceUnit::element)], size, 0.25 * size + 0.2)
        << size;
  }
}

TEST(MeasuredPrices, AreSelectedByNameOrPrefix) {
  EXPECT_EQ(select_prices({}).size(), kPriceItems);
  EXPECT_EQ(select_prices({"texture"}).size(), 6u);
  EXPECT_EQ(select_prices({"frame"}), std::vector{PriceItem::frame});
  EXPECT_THROW(select_prices({"texture", "nothing"}), std::exception);
}

TEST(MeasuredPrices, IncludeTheItemsThatTheyAreMeasuredAgainst) {
  PriceList list = empty_price_list(InstructionSet::scalar);
  std::size_t last = 0;
  const std::vector<PriceItem> measured =
      measure_prices(list, {PriceItem::shown_tile_pixel}, InstructionSet::scalar, 0.001,
                     [&](std::size_t count, std::size_t pairs) {
                       EXPECT_EQ(count, ++last);
                       EXPECT_EQ(pairs, 6u) << "two pairs in three passes";
                     });
  EXPECT_EQ(measured, (std::vector{PriceItem::shown_pixel, PriceItem::shown_tile_pixel}));
  EXPECT_GT(list[PriceItem::shown_pixel].nanoseconds, 0);
  EXPECT_LE(list[PriceItem::shown_pixel].low, list[PriceItem::shown_pixel].nanoseconds);
  EXPECT_GE(list[PriceItem::shown_pixel].high, list[PriceItem::shown_pixel].nanoseconds);
  EXPECT_EQ(list[PriceItem::vertex].nanoseconds, 0) << "not asked for";
}

TEST(PriceFile, IsReadAsItWasWritten) {
  const PriceList list = example_list();
  const PriceList read = parse_prices(price_json(list), "prices.json");
  EXPECT_EQ(read.processor, list.processor);
  EXPECT_EQ(read.instruction_set, list.instruction_set);
  EXPECT_EQ(read.version, list.version);
  for (std::size_t i = 0; i < kPriceItems; ++i) {
    EXPECT_EQ(read.prices[i].nanoseconds, list.prices[i].nanoseconds) << i;
    EXPECT_EQ(read.prices[i].low, list.prices[i].low) << i;
    EXPECT_EQ(read.prices[i].high, list.prices[i].high) << i;
  }
}

TEST(PriceFile, HasOnlyMeasuredPrices) {
  PriceList list = empty_price_list(InstructionSet::scalar);
  list[PriceItem::vertex] = {6, 5, 7};
  EXPECT_THAT(price_json(list), testing::Not(HasSubstr("pixel_spot")));
  const PriceList read = parse_prices(price_json(list), "prices.json");
  EXPECT_TRUE(is_measured(read[PriceItem::vertex]));
  EXPECT_FALSE(is_measured(read[PriceItem::draw]));
}

TEST(PriceFile, SaysWhatIsWrong) {
  EXPECT_THAT(error_of_parsing("{"), HasSubstr("prices.json: is no price list: "));
  EXPECT_THAT(error_of_parsing("{}"), HasSubstr("processor"));
  std::string other_item = price_json(example_list());
  other_item.replace(other_item.find("\"draw\""), 6, "\"drew\"");
  EXPECT_THAT(error_of_parsing(other_item), HasSubstr("found \"drew\", expected the name of a price"));
}

TEST(PriceFile, LiesInTheUsersCacheFolder) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "price_cache";
  std::filesystem::remove_all(folder);
  const Variable cache("XDG_CACHE_HOME", folder.string());
  PriceList list = example_list();
  EXPECT_FALSE(cached_prices(available_instruction_sets().front()));
  const std::filesystem::path file = cache_prices(list);
  EXPECT_EQ(file.parent_path(), folder / "tessera");
  EXPECT_THAT(file.string(), HasSubstr(list.instruction_set + "-" + list.version + ".json"));
  const std::optional<PriceList> read = cached_prices(available_instruction_sets().front());
  ASSERT_TRUE(read);
  EXPECT_EQ((*read)[PriceItem::draw].nanoseconds, list[PriceItem::draw].nanoseconds);
  list.processor = "Other (TM) CPU @ 3 GHz";
  EXPECT_THAT(cached_price_file(list).filename().string(), HasSubstr("prices-Other-TM-CPU-3-GHz-"));
}

TEST(PriceFile, LiesInTheHomeFolderWithoutTheVariable) {
  const Variable cache("XDG_CACHE_HOME", "relative paths are ignored");
  const Variable home("HOME", "/home/someone");
  EXPECT_EQ(cached_price_file(example_list()).parent_path(), "/home/someone/.cache/tessera");
}

TEST(PriceCheck, SummarizesErrorsAndOrder) {
  // Within 25 %, within 60 %, and neither; the last two are in the wrong order.
  const std::vector<CheckedScene> scenes{{.name = "a", .measured = 1, .predicted = 1.2},
                                         {.name = "b", .measured = 2, .predicted = 3},
                                         {.name = "c", .measured = 4, .predicted = 1.3}};
  EXPECT_EQ(
      checked_summary(scenes),
      "\n3 scenes: 33 % predicted within 25 %, 67 % within 60 %; 66.7 % of 3 pairs whose times differ by "
      "half or more in the right order\n");
}

}  // namespace
}  // namespace tessera::bench::prices_test
