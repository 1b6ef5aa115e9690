// What many measurements of one thing say.
#pragma once

#include <vector>

namespace tessera::bench {

struct Statistics {
  double median = 0, low_quartile = 0, high_quartile = 0, percentile_95 = 0, percentile_99 = 0, least = 0;
};

/// Percentiles are measured values: the smallest one that at least so many are not above. @pre values is not empty
Statistics statistics_of(std::vector<double> values);

}  // namespace tessera::bench
