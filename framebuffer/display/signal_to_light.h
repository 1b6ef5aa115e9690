// Signal of a tube -> light of its beam, for blocks of rows.
#pragma once

#include <array>
#include <vector>

#include "framebuffer/tessera/enums.hpp"

namespace tessera::detail {

/// Rows that are processed together. A value of a block is an array of kBlockRows floats, one per row.
inline constexpr int kBlockRows = 16;

inline constexpr int kMaxSubsamples = 16;

/// Light over signal, interpolated linearly between evenly spaced nodes.
struct LightTable {
  float first = 0;  ///< signal of the first node
  float nodes_per_unit = 0;
  std::vector<float> values;  ///< at least 2; signals outside have the light of the nearest node

  float at(float signal) const;
};

/// BT.1886 with any exponent: L = a max(V + b, 0)^gamma, 1 at signal 1 and `black` at signal 0. Nodes from
/// signal -0.25 to 1.75.
LightTable tube_light(double gamma, double black);

/// Video amplifier, a single pole, and electron gun.
struct SignalResponse {
  int subsamples = 1;  ///< per sample of the signal, 1 to kMaxSubsamples, evenly spaced
  /// Share of a step at the beginning of a sample that is still missing at the centre of each subsample, and
  /// at the end of the sample.
  std::array<float, kMaxSubsamples> missing{};
  float missing_at_end = 0;
  const LightTable* light = nullptr;
};

/// @param time_constant  of the pole, in samples of the signal; 0: the signal follows at once
SignalResponse signal_response(int subsamples, double time_constant, const LightTable& light);

/// Signals that are held for a sample each pass the pole, which starts at signal 0, and become light.
/// @param signal  [sample][row]
/// @param light   [sample][subsample][row]
using SignalToLightFn = void(const float* signal, int samples, const SignalResponse& response, float* light);
SignalToLightFn* signal_to_light_for(InstructionSet isa);

}  // namespace tessera::detail
