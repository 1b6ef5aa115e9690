// Runs calls of the library in every floating-point mode.
#pragma once

#include <gtest/gtest.h>

#include "tests/numerics/host_mode.h"

#if defined(__x86_64__)

#include <cstdio>
#include <string>

namespace tessera::test {

inline std::string described(unsigned mode) {
  char text[64];
  std::snprintf(text, sizeof text, "mode %04x", mode);
  return text;
}

/// Runs `act` in the default mode and then in each mode. result() returns the outcome of the last run, which
/// must always be the same.
template <class Act, class Result>
void expect_the_same_in_every_mode(const Act& act, const Result& result) {
  act();
  const auto expected = result();
  for (const unsigned mode : HostModes::all()) {
    bool untouched = false;
    {
      const HostMode host(mode);
      act();
      untouched = host.is_untouched();
    }
    ASSERT_TRUE(untouched) << described(mode);
    ASSERT_TRUE(result() == expected) << described(mode);
  }
}

}  // namespace tessera::test

#endif
