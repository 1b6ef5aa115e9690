// sRGB codes of linear light, by straight lines.
#pragma once

#include <array>
#include <cstdint>

namespace tessera::detail {

/// Code of a light from kMin to kMax: floor(slope[s] light + offset[s]), where s is the segment. The upper
/// bits of the float choose it: 64 segments per octave.
struct SrgbTable {
  static constexpr float kMin = 0x1p-13f;  ///< its code is below 1/2
  static constexpr float kMax = 1;
  static constexpr int kShift = 23 - 6;
  static constexpr int kFirstSegment = (127 - 13) << 6;  ///< kMin's bits >> kShift
  static constexpr std::size_t kSegments = (13 << 6) + 1;

  std::array<float, kSegments> slope, offset;
};

const SrgbTable& srgb_table();

}  // namespace tessera::detail
