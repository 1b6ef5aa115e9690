// Depth formats and the levels of exact depths in them.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include "engine/tessera/tessera.hpp"
#include "tests/numerics/window_triangle.h"

namespace tessera::test {

struct DepthCase {
  DepthFormat format;
  int bits;
  const char* name;
  bool is_float() const { return format == DepthFormat::float32; }
  /// Largest stored integer.
  std::int64_t levels() const { return (std::int64_t{1} << bits) - 1; }
};
inline constexpr DepthCase kUnorm16{DepthFormat::unorm16, 16, "16 bits"},
    kUnorm24{DepthFormat::unorm24, 24, "24 bits"}, kUnorm32{DepthFormat::unorm32, 32, "32 bits"},
    kFloat32{DepthFormat::float32, 32, "floats"};
inline constexpr DepthCase kUnorms[] = {kUnorm16, kUnorm24, kUnorm32};
inline constexpr DepthCase kDepthCases[] = {kUnorm16, kUnorm24, kUnorm32, kFloat32};

/// floor(numerator / denominator).
inline Whole floor_of(Whole numerator, Whole denominator) {
  return numerator / denominator - (numerator % denominator < 0 ? 1 : 0);
}

/// floor(z (2^b - 1) + 1/2) of the depth z = numerator / denominator.
inline std::int64_t exact_level(const DepthCase& depth, Whole numerator, Whole denominator) {
  return static_cast<std::int64_t>(floor_of(2 * numerator * depth.levels() + denominator, 2 * denominator));
}

inline float float_of(std::uint32_t bits) { return std::bit_cast<float>(bits); }

}  // namespace tessera::test
