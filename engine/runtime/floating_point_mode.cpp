#include "engine/runtime/floating_point_mode.h"

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace tessera::detail {

#if defined(__x86_64__)
FloatingPointMode::FloatingPointMode() : saved_(_mm_getcsr()) {
  _mm_setcsr(0x1f80);  // exceptions masked, round to nearest, neither FTZ nor DAZ
}
FloatingPointMode::~FloatingPointMode() { _mm_setcsr(static_cast<unsigned>(saved_)); }
#elif defined(__aarch64__)
FloatingPointMode::FloatingPointMode() {
  __asm__ volatile("mrs %0, fpcr" : "=r"(saved_));
  __asm__ volatile("msr fpcr, %0" : : "r"(0ULL));
}
FloatingPointMode::~FloatingPointMode() { __asm__ volatile("msr fpcr, %0" : : "r"(saved_)); }
#else
#error "FloatingPointMode: name the floating-point control register of this architecture"
#endif

}  // namespace tessera::detail
