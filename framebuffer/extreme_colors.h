// Entries at the extremes of a picture. Dither mixes entries, so it reaches only colours between them, and
// k-means, which takes means, leaves the darkest, lightest and most saturated colours outside.
#pragma once

#include <vector>

#include "framebuffer/color_points.h"
#include "framebuffer/tessera/enums.hpp"

namespace tessera::detail {

/// Moves the centres that are nearest to the extreme points in 26 directions onto them, as long as the error
/// of the clustering (k_means.h) grows by no more than an eighth.
/// - Few centres stay as they are, because each has too many points.
/// @param centers  means of their points, as k_means() gives them
void keep_extremes(const ColorPoints& points, InstructionSet isa, std::vector<Oklab>& centers);

}  // namespace tessera::detail
