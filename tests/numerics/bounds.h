// Errors as they are measured beside the bounds that README.md promises. The table of all stands at the end of what numerics_tests prints.
#pragma once

#include <string>

namespace tessera::test {

/// Expects measured <= promised, and adds a row to the table.
void expect_within(const std::string& quantity, long double measured, long double promised, const std::string& unit);

/// Puts what Mesa comes to beside a quantity that was measured; nothing is expected of it.
void set_beside(const std::string& quantity, long double mesas);

}  // namespace tessera::test
