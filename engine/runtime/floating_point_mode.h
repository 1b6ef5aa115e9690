// The floating-point mode of the library, whatever mode the caller has set.
#pragma once

namespace tessera::detail {

/// Rounding to nearest, denormals kept, exceptions masked until the end of the scope; then the mode before.
/// Public functions that compute enter it: in the caller's mode a comparison with a NaN may trap.
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
