// Resizes pictures by areas, in linear light.
#pragma once

#include "engine/program/imageio/picture.h"

namespace tessera::program {

/// Returns the picture in another size. Each pixel of the result is the mean of the area that it covers.
/// - The mean is taken in linear light, as an eye averages pixels that it cannot tell apart: a pattern of
///   equally many black and white pixels becomes 188, not 128.
/// - Sizes that divide each other replicate pixels, or average whole blocks.
/// - The result is opaque, and has the same bits on every machine.
/// @param width, height  pixels, at least 1
Picture area_resampled(const Picture& source, int width, int height);

}  // namespace tessera::program
