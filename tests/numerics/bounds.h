// Errors as they are measured beside the bounds that README.md promises. The table of all stands at the end
// of what numerics_tests prints.
#pragma once

#include <cmath>
#include <concepts>
#include <limits>
#include <string>

namespace tessera::test {

/// Raises `worst` to the largest of the errors, where one is larger. A NaN counts as infinity, which no bound
/// allows: std::max would pass it over.
/// @pre worst is a number
template <std::floating_point Number, class... Errors>
void update_worst(Number& worst, Errors... errors) {
  const auto keep = [&worst](Number error) {
    if (error <= worst) return;
    worst = std::isnan(error) ? std::numeric_limits<Number>::infinity() : error;
  };
  (keep(static_cast<Number>(errors)), ...);
}

/// Expects measured <= promised, which a NaN is not, and adds a row to the table.
void expect_within(const std::string& quantity, long double measured, long double promised,
                   const std::string& unit);

/// Puts what Mesa comes to beside a quantity that was measured; nothing is expected of it.
void report_mesa_figure(const std::string& quantity, long double mesas);

}  // namespace tessera::test
