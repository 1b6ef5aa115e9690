// Point coverage: a square of whole pixels [GL 2.1, 3.3.1], or with several samples a disc [3.3.3].
#pragma once

#include "window.h"

namespace tessera::reference {

/// Calls `take` for each covered pixel. All have the vertex's depth and weights.
/// @param size  in pixels, above 0
/// @param depth_offset  added to the depth before it is clamped to 0..1
void rasterize_point(const WindowVertex& vertex, double size, double depth_offset, const Window& window,
                     const FragmentCallback& take);

}  // namespace tessera::reference
