// What many measurements of one thing say.
#pragma once

#include <vector>

namespace tessera::bench {

struct Statistics {
  double median = 0, low_quartile = 0, high_quartile = 0, percentile_95 = 0, percentile_99 = 0, min = 0;
  /// What holds the median of the values' distribution, whichever that is, 19 times of 20, of six independent
  /// values or more; of fewer the least and the greatest. Source: W. J. Conover, Practical Nonparametric
  /// Statistics, 3.2: the values of ranks n/2 -+ 0.98 sqrt(n).
  double median_ci_low = 0, median_ci_high = 0;
};

/// Percentiles are measured values: the smallest one that at least so many are not above. @pre values is not
/// empty
Statistics statistics_of(std::vector<double> values);

/// Of medians, and how far from it the bounds of both let it be, at their widest.
struct Ratio {
  double value = 1, low = 1, high = 1;
};
Ratio ratio_of(const Statistics& a, const Statistics& b);

}  // namespace tessera::bench
