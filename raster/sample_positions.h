// Positions of the coverage samples in a pixel: the standard patterns of Direct3D 11.
#pragma once

#include <cstdint>

#include "raster/fixed_point.h"

namespace tessera::detail {

inline constexpr int kMaxSamples = 8;

/// Offset from the pixel's centre, in 1/256 pixel, y down.
struct SamplePosition {
  std::int32_t x, y;
};

inline constexpr std::int32_t kSampleUnit = kSubpixelScale / 16;  ///< 1/16 pixel
inline constexpr SamplePosition kCenterSample[1] = {{0, 0}};
inline constexpr SamplePosition kFourSamples[4] = {{-2 * kSampleUnit, -6 * kSampleUnit},
                                                   {6 * kSampleUnit, -2 * kSampleUnit},
                                                   {-6 * kSampleUnit, 2 * kSampleUnit},
                                                   {2 * kSampleUnit, 6 * kSampleUnit}};
inline constexpr SamplePosition kEightSamples[8] = {
    {1 * kSampleUnit, -3 * kSampleUnit}, {-1 * kSampleUnit, 3 * kSampleUnit},
    {5 * kSampleUnit, 1 * kSampleUnit},  {-3 * kSampleUnit, -5 * kSampleUnit},
    {-5 * kSampleUnit, 5 * kSampleUnit}, {-7 * kSampleUnit, -1 * kSampleUnit},
    {3 * kSampleUnit, 7 * kSampleUnit},  {7 * kSampleUnit, -7 * kSampleUnit}};

/// Positions of 4 or 8 samples; one at the centre for any other number.
///
/// Coverage and depth at a sample are those at the pixel's centre of the triangle moved by the negative
/// offset. Samples therefore use the arithmetic of centres and are as exact.
constexpr const SamplePosition* sample_positions(int samples) {
  if (samples == 4) return kFourSamples;
  return samples == 8 ? kEightSamples : kCenterSample;
}

/// Largest distance of a sample from the centre, per axis.
constexpr std::int32_t sample_reach(int samples) {
  if (samples == 4) return 6 * kSampleUnit;
  return samples == 8 ? 7 * kSampleUnit : 0;
}

}  // namespace tessera::detail
