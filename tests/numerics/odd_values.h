// Numbers that no picture needs but any caller may pass: non-finite values, denormals, -0, and the ends of
// each type's range.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <vector>

namespace tessera::test {

/// All odd values of a floating-point or integer type.
template <class T>
std::vector<T> odd_values() {
  using Limits = std::numeric_limits<T>;
  if constexpr (std::is_floating_point_v<T>) {
    std::vector<T> values{Limits::quiet_NaN(),
                          Limits::signaling_NaN(),
                          Limits::infinity(),
                          Limits::denorm_min(),
                          Limits::min() - Limits::denorm_min(),
                          Limits::min(),
                          T(0),
                          Limits::epsilon(),
                          T(1) + Limits::epsilon(),
                          T(1) - Limits::epsilon() / 2,
                          T(16384.5),
                          T(1e9),
                          T(3e18),
                          std::sqrt(Limits::max()),
                          Limits::max()};
    for (std::size_t i = 0, count = values.size(); i < count; ++i)
      values.push_back(std::copysign(values[i], T(-1)));
    return values;
  } else if constexpr (std::is_signed_v<T>) {
    return {Limits::min(), Limits::min() + 1, T(-32769),    T(-1), T(0), T(1), T(2), T(7), T(16384), T(16385),
            T(1 << 30),    Limits::max() - 1, Limits::max()};
  } else {
    return {T(0),         T(1), T(255), T(256), T(1u << 24), T(Limits::max() / 2 + 1), Limits::max() - 1,
            Limits::max()};
  }
}

}  // namespace tessera::test
