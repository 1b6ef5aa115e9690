// Pictures of the double-precision reference renderer, which errors are measured against.
#pragma once

#include <functional>
#include <vector>

#include "engine/program/imageio/picture.h"
#include "tests/reference/scene.h"

namespace tessera::accuracy {

struct ReferencePicture {
  /// Red, green and blue of each pixel, 0 to 1, before rounding to levels; rows from the top without gaps.
  std::vector<float> unrounded;
  program::Picture stored;  ///< rounded to 8 bits
};

struct References {
  ReferencePicture point;  ///< one sample at each pixel's centre, as the scene asks
  ReferencePicture area;   ///< the mean of 16x16 samples, the centres of a pixel's sixteenths
};

/// Samples per side of a pixel in References::area.
inline constexpr int kSamplesPerSide = 16;

/// One sample per pixel, whatever the scene asks for.
ReferencePicture render_point_reference(reference::Scene scene);

/// 16x16 samples per pixel.
/// - Returns the same bits for any number of threads: samples are summed as integers.
/// - Every sample evaluates its own colour, with the level of detail that textures have at full pixels.
/// @param progress  called with the done share, 0 to 1; false cancels. Called from one thread at a time.
/// @throws Cancelled if `progress` returns false
ReferencePicture render_area_reference(reference::Scene scene, int threads,
                                       const std::function<bool(double)>& progress);

}  // namespace tessera::accuracy
