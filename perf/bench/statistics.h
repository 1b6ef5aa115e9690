// Order statistics of repeated measurements.
#pragma once

#include <vector>

namespace tessera::bench {

struct Statistics {
  double median = 0;
  double low_quartile = 0;
  double high_quartile = 0;
  double percentile_5 = 0;
  double percentile_95 = 0;
  double percentile_99 = 0;
  double min = 0;
  /// Distribution-free 95 % confidence interval of the median, for six independent values or more: the values
  /// of ranks n/2 -+ 0.98 sqrt(n). With fewer values: the smallest and the largest.
  /// Source: W. J. Conover, Practical Nonparametric Statistics, 3.2.
  double median_ci_low = 0, median_ci_high = 0;
};

/// Percentiles are measured values: the smallest value that at least that share of values does not exceed.
/// @pre values is not empty
Statistics statistics_of(std::vector<double> values);

/// Ratio of two medians. `low` and `high` combine the opposite ends of both confidence intervals.
struct Ratio {
  double value = 1, low = 1, high = 1;
};
Ratio ratio_of(const Statistics& a, const Statistics& b);

}  // namespace tessera::bench
