// The floating-point mode of the library, independent of the caller's mode.
#pragma once

namespace tessera::detail {

/// Sets rounding to nearest, keeps denormals and masks exceptions, until the end of the scope restores the
/// mode before. Public functions that compute use it: in the caller's mode a comparison with a NaN may trap.
class FloatingPointMode {
 public:
  FloatingPointMode();
  ~FloatingPointMode();
  FloatingPointMode(const FloatingPointMode&) = delete;
  FloatingPointMode& operator=(const FloatingPointMode&) = delete;

 private:
  unsigned long long saved_;
};

}  // namespace tessera::detail
