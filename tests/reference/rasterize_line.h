// Line coverage: pixels whose diamonds the line leaves; for wider lines columns or rows of such pixels [GL
// 2.1, 3.4.2]; with several samples a rectangle around the line [3.4.4].
#pragma once

#include "window.h"

namespace tessera::reference {

/// Calls `take` for each covered pixel. Depth and weights are those of the pixel's centre (for multisampled
/// depth: of each sample) projected onto the line [GL 2.1, equations 3.5 and 3.6].
/// @param width  in pixels, above 0
/// @param depth_offset  added to the depth before it is clamped to 0..1
void rasterize_line(const WindowVertex& a, const WindowVertex& b, double width, double depth_offset,
                    const Window& window, const FragmentCallback& take);

}  // namespace tessera::reference
