// Where the coverage samples of a pixel lie: the standard patterns of Direct3D 11.
#pragma once

#include <cstdint>

#include "raster/fixed_point.h"

namespace tessera::detail {

inline constexpr int kMaxSamples = 8;

/// From the pixel's centre, in 1/256 pixel, y down.
struct SamplePosition {
  std::int32_t x, y;
};

inline constexpr std::int32_t kSampleUnit = kSubpixelScale / 16;
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

/// The positions of 4 or 8 samples; of any other number one at the centre.
///
/// What a sample sees of a triangle is what the centre sees of the triangle moved the other way: samples need
/// no coverage and no depth of their own, and are as exact as centres.
constexpr const SamplePosition* sample_positions(int samples) {
  return samples == 4 ? kFourSamples : samples == 8 ? kEightSamples : kCenterSample;
}

/// No sample is farther from the centre, in x or in y.
constexpr std::int32_t sample_reach(int samples) {
  return samples == 4 ? 6 * kSampleUnit : samples == 8 ? 7 * kSampleUnit : 0;
}

}  // namespace tessera::detail
