// Assertion of internal invariants: checked in debug and sanitizer builds, removed from release builds.
#pragma once

#if defined(TESSERA_CHECKED)
#include <cstdio>
#include <cstdlib>
#define TESSERA_ASSERT(condition)                                                            \
  do {                                                                                       \
    if (!(condition)) {                                                                      \
      std::fprintf(stderr, "%s:%d: assertion failed: %s\n", __FILE__, __LINE__, #condition); \
      std::abort();                                                                          \
    }                                                                                        \
  } while (false)
#else
#define TESSERA_ASSERT(condition) static_cast<void>(0)
#endif
