#include "perf/prices/measure_prices.h"

#include <chrono>
#include <memory>
#include <random>
#include <set>

#include <CLI/CLI.hpp>

#include "perf/bench/statistics.h"
#include "perf/prices/price_pairs.h"

namespace tessera::bench {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kPasses = 3;
constexpr int kMinBlocks = 5;  ///< per pass

std::unique_ptr<Workload> workload_of(const PriceFrame& frame, InstructionSet instruction_set) {
  const WorkloadEntry entry =
      drawn("price", "", [frame](int, int, std::uint32_t) { return price_drawing(frame); });
  return entry.make({.options = {.threads = 1, .instruction_set = instruction_set}});
}

void check_picture(PriceItem item, Workload& workload) {
  if (const std::string fault = workload.fault(); !fault.empty())
    throw Error("price " + std::string(code(item)) + ": " + fault);
}

/// Time of a frame, after one that warms up the caches.
double nanoseconds_of_frame(Workload* workload) {
  if (workload == nullptr) return 0;
  workload->draw();
  const Clock::time_point start = Clock::now();
  workload->draw();
  return std::chrono::duration<double, std::nano>(Clock::now() - start).count();
}

/// A pair and the differences of its frame times, nanoseconds.
struct MeasuredPair {
  PricePair pair;
  std::vector<double> differences{};

  void measure(InstructionSet instruction_set, double seconds, std::mt19937& random) {
    const std::unique_ptr<Workload> with = workload_of(pair.with, instruction_set);
    const std::unique_ptr<Workload> without =
        pair.without ? workload_of(*pair.without, instruction_set) : nullptr;
    if (differences.empty()) {
      check_picture(pair.item, *with);
      if (without) check_picture(pair.item, *without);
    }
    nanoseconds_of_frame(with.get());
    nanoseconds_of_frame(without.get());
    const Clock::time_point end =
        Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
    for (int block = 0; block < kMinBlocks || Clock::now() < end; ++block) {
      const bool with_first = random() % 2 == 0;
      const double first = nanoseconds_of_frame(with_first ? with.get() : without.get());
      const double second = nanoseconds_of_frame(with_first ? without.get() : with.get());
      differences.push_back(with_first ? first - second : second - first);
    }
  }
};

/// Units of a pair: those of `with` if both frames have the same number, else the difference.
class PairUnits {
 public:
  explicit PairUnits(const PricePair& pair) : with_(units_of(pair.with)) {
    if (pair.without) without_ = units_of(*pair.without);
  }
  double operator()(PriceUnit unit) const {
    const auto index = static_cast<std::size_t>(unit);
    return with_[index] == without_[index] ? with_[index] : with_[index] - without_[index];
  }

 private:
  UnitCounts with_, without_{};
};

/// Known work that `with` has in addition; negative counts for work that it lacks.
WorkCounts known_work(const PricePair& pair, const PairUnits& units) {
  WorkCounts work;
  for (const PriceItem item : pair.known) work[item] += units(unit(item));
  for (const PriceItem item : pair.instead) work[item] -= units(unit(item));
  if (pair.has_known_triangles)
    add_triangles(work, units(PriceUnit::element), units(PriceUnit::covered_pixel));
  return work;
}

/// Sum of units times prices, nanoseconds; adds up the intervals at their opposite ends.
Price price_of(const WorkCounts& work, const PriceList& list) {
  Price sum;
  for (std::size_t i = 0; i < kPriceItems; ++i) {
    const Price& price = list.prices[i];
    const double units = work.units[i];
    sum.nanoseconds += units * price.nanoseconds;
    sum.low += units * (units > 0 ? price.low : price.high);
    sum.high += units * (units > 0 ? price.high : price.low);
  }
  return sum;
}

Price measured_price(const MeasuredPair& measured, const PriceList& list) {
  const PricePair& pair = measured.pair;
  const PairUnits units(pair);
  const Statistics difference = statistics_of(measured.differences);
  const Price known = price_of(known_work(pair, units), list);
  const double count = pair.count * units(unit(pair.item));
  return {.nanoseconds = (difference.median - known.nanoseconds) / count,
          .low = (difference.median_ci_low - known.high) / count,
          .high = (difference.median_ci_high - known.low) / count};
}

/// The items and, transitively, what they are measured against.
std::set<PriceItem> with_known(const std::vector<PriceItem>& items, const std::vector<PricePair>& pairs) {
  std::set<PriceItem> all(items.begin(), items.end());
  // Known items come before the pairs that use them.
  for (auto pair = pairs.rbegin(); pair != pairs.rend(); ++pair) {
    if (!all.contains(pair->item)) continue;
    all.insert(pair->known.begin(), pair->known.end());
    all.insert(pair->instead.begin(), pair->instead.end());
    if (pair->has_known_triangles)
      for (const PricePair& other : pairs)
        if (is_triangle_size(other.item)) all.insert(other.item);
  }
  return all;
}

}  // namespace

std::vector<PricePair> price_pairs() {
  std::vector<PricePair> all;
  for (const auto& part : {frame_price_pairs(), vertex_price_pairs(), triangle_price_pairs(),
                           operation_price_pairs(), shading_price_pairs()})
    all.insert(all.end(), part.begin(), part.end());
  return all;
}

std::vector<PriceItem> select_prices(const std::vector<std::string>& names) {
  std::vector<PriceItem> items;
  std::set<std::string> used;
  for (std::size_t i = 0; i < kPriceItems; ++i) {
    const auto item = static_cast<PriceItem>(i);
    bool is_selected = names.empty();
    for (const std::string& name : names) {
      if (!code(item).starts_with(name)) continue;
      used.insert(name);
      is_selected = true;
    }
    if (is_selected) items.push_back(item);
  }
  for (const std::string& name : names)
    if (!used.contains(name))
      throw CLI::ValidationError(
          "names", "found \"" + name + "\", expected the name of a price or a prefix; see --list");
  return items;
}

std::vector<PriceItem> measure_prices(PriceList& list, const std::vector<PriceItem>& items,
                                      InstructionSet instruction_set, double seconds,
                                      const PriceProgress& progress) {
  const std::vector<PricePair> pairs = price_pairs();
  const std::set<PriceItem> needed = with_known(items, pairs);
  std::vector<MeasuredPair> measured;
  for (const PricePair& pair : pairs)
    if (needed.contains(pair.item)) measured.push_back({pair});
  std::mt19937 random(1);
  std::size_t count = 0;
  for (int pass = 0; pass < kPasses; ++pass)
    for (MeasuredPair& pair : measured) {
      pair.measure(instruction_set, seconds / kPasses, random);
      if (progress) progress(++count, kPasses * measured.size());
    }
  for (const MeasuredPair& pair : measured) list[pair.pair.item] = measured_price(pair, list);
  return {needed.begin(), needed.end()};
}

}  // namespace tessera::bench
