// Periodic patterns of light, as sums of products of columns and rows.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace tessera::detail {

/// Light of a pattern in pixels, 1 on average: the sum over terms j of
/// row_factors[j][row] * column_factors[color][j][column].
struct PatternTables {
  std::array<std::vector<std::vector<float>>, 3> column_factors;
  std::vector<std::vector<float>> row_factors;

  double at(std::size_t color, std::size_t column, std::size_t row) const {
    double sum = 0;
    for (std::size_t j = 0; j < row_factors.size(); ++j)
      sum += static_cast<double>(column_factors[color][j][column]) * static_cast<double>(row_factors[j][row]);
    return sum;
  }
};

}  // namespace tessera::detail
