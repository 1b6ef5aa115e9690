// Errors as they are measured beside the bounds that README.md promises. The table of all stands at the end of what numerics_tests prints.
#pragma once

#include <string>

namespace tessera::test {

/// Expects measured <= promised, and adds a row to the table.
void expect_within(const std::string& quantity, long double measured, long double promised, const std::string& unit);

}  // namespace tessera::test
