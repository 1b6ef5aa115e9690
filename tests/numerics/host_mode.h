// Floating-point modes that a host program, a plug-in or another library may leave behind.
#pragma once

#if defined(__x86_64__)

#include <immintrin.h>

#include <string>
#include <vector>

namespace tessera::test {

/// Bits of the control register. The default masks all exceptions and sets nothing else.
struct HostModes {
  static constexpr unsigned kDefault = 0x1f80;
  static constexpr unsigned kFlushToZero = 0x8000;
  static constexpr unsigned kDenormalsAreZero = 0x0040;
  /// To nearest, down, up, towards 0.
  static constexpr unsigned kRounding[] = {0x0000, 0x2000, 0x4000, 0x6000};
  static constexpr unsigned kAllTraps = 0x1f80;
  static constexpr unsigned kUsualTraps = 0x0680;  ///< invalid operation, division by 0, overflow
  static constexpr unsigned kControl = 0xffc0;     ///< all bits but the exception flags

  /// Every combination of rounding, flushing and traps.
  static std::vector<unsigned> all() {
    std::vector<unsigned> modes;
    for (const unsigned rounding : kRounding)
      for (const unsigned flush : {0u, kFlushToZero})
        for (const unsigned denormals : {0u, kDenormalsAreZero})
          for (const unsigned traps : {0u, kUsualTraps, kAllTraps})
            modes.push_back((kDefault & ~traps) | rounding | flush | denormals);
    return modes;
  }
};

/// Sets the mode for the lifetime of the object.
class HostMode {
 public:
  explicit HostMode(unsigned mode) : saved_(_mm_getcsr()), mode_(mode), x87_(x87()) { _mm_setcsr(mode); }
  ~HostMode() { _mm_setcsr(saved_); }
  HostMode(const HostMode&) = delete;
  HostMode& operator=(const HostMode&) = delete;
  /// Whether the mode is unchanged and no new exception flag is set.
  bool is_untouched() const { return _mm_getcsr() == mode_ && x87() == x87_; }

 private:
  static unsigned short x87() {
    unsigned short word = 0;
    __asm__ volatile("fnstcw %0" : "=m"(word));
    return word;
  }
  unsigned saved_;
  unsigned mode_;
  unsigned short x87_;
};

}  // namespace tessera::test

#endif
