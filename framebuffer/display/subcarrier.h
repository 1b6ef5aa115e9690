// The colour subcarrier on one line.
#pragma once

#include <array>

namespace tessera::detail {

/// Samples of the carriers of U, sin(angle), and of V, cos(angle) or its negative. They repeat after four
/// samples; sample k + 1 is also the carrier at sample k, a quarter cycle later. The arrays have room for
/// vectors that begin at any of the first five samples.
struct Subcarrier {
  static constexpr int kSize = 16 + 4;
  std::array<float, kSize> u, v;
};

/// @param degrees  angle at sample 0
/// @param v_sign   1 or -1
/// @param gain     of both carriers
Subcarrier make_subcarrier(double degrees, int v_sign, double gain = 1);

}  // namespace tessera::detail
