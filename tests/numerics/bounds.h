// Compares measured errors with the bounds in README.md. numerics_tests prints the table of all rows when it
// ends.
#pragma once

#include <cmath>
#include <concepts>
#include <limits>
#include <string>

namespace tessera::test {

/// Raises `worst` to the largest of the errors.
/// A NaN counts as infinity, which exceeds every bound; std::max would ignore it.
/// @pre worst is not NaN
template <std::floating_point Number, class... Errors>
void update_worst(Number& worst, Errors... errors) {
  const auto keep = [&worst](Number error) {
    if (error <= worst) return;
    worst = std::isnan(error) ? std::numeric_limits<Number>::infinity() : error;
  };
  (keep(static_cast<Number>(errors)), ...);
}

/// Expects measured <= promised (false for NaN) and adds a row to the table.
void expect_within(const std::string& quantity, long double measured, long double promised,
                   const std::string& unit);

/// Adds Mesa's figure to the row of a measured quantity. Nothing is expected of it.
void report_mesa_figure(const std::string& quantity, long double mesas);

}  // namespace tessera::test
