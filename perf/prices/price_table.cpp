#include "perf/prices/price_table.h"

#include "perf/bench/text.h"

namespace tessera::bench {

std::string price_table_heading(const PriceList& list) {
  return formatted(
      "processor %s, %s, one thread; nanoseconds and their 95 %% interval\n\n%-32s %10s   %-24s %s\n",
      list.processor.c_str(), list.instruction_set.c_str(), "price", "ns", "interval", "per");
}

std::string price_line(const PriceList& list, PriceItem item) {
  const Price& price = list[item];
  const std::string interval = formatted("(%.3g .. %.3g)", price.low, price.high);
  return formatted("%-32s %10.3g   %-24s %s\n", std::string(code(item)).c_str(), price.nanoseconds,
                   interval.c_str(), std::string(name(unit(item))).c_str());
}

}  // namespace tessera::bench
