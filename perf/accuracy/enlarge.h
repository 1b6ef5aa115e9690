// Enlarges a picture of half or quarter resolution.
#pragma once

#include "engine/program/imageio/picture.h"

namespace tessera::accuracy {

/// Bilinear interpolation between pixel centres, in integers, rounded to the nearest level; beyond the
/// outermost centres the border pixels continue.
/// @param factor  2 or 4
/// @param large   factor times as wide and high as `small`
void enlarge(const program::Picture& small, int factor, program::Picture& large);

}  // namespace tessera::accuracy
