#include "perf/bench/statistics.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace tessera::bench {

Statistics statistics_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const auto percentile = [&](double share) {
    return values[static_cast<std::size_t>(
        std::max(std::ceil(share * static_cast<double>(values.size())) - 1, 0.0))];
  };
  const auto count = static_cast<double>(values.size());
  const auto rank = static_cast<std::size_t>(std::max(std::round(count / 2 - 0.98 * std::sqrt(count)), 1.0));
  return {.median = percentile(0.5),
          .low_quartile = percentile(0.25),
          .high_quartile = percentile(0.75),
          .percentile_5 = percentile(0.05),
          .percentile_95 = percentile(0.95),
          .percentile_99 = percentile(0.99),
          .min = values.front(),
          .median_ci_low = values[rank - 1],
          .median_ci_high = values[values.size() - rank]};
}

Ratio ratio_of(const Statistics& a, const Statistics& b) {
  return {a.median / b.median, a.median_ci_low / b.median_ci_high, a.median_ci_high / b.median_ci_low};
}

}  // namespace tessera::bench
