// Which samples a line covers: the pixels whose diamonds it leaves, wider lines columns or rows of such
// pixels [GL 2.1, 3.4.2], or with several samples a rectangle around it [3.4.4].
#pragma once

#include "window.h"

namespace tessera::reference {

/// Calls `take` for each pixel covered. Depth and shares are those of the line where the pixel's centre
/// (depth of several samples: each sample) is projected on it [GL 2.1, equations 3.5 and 3.6].
/// @param width  in pixels, above 0
/// @param depth_offset  added to the depth before it is clamped to 0..1
void rasterize_line(const WindowVertex& a, const WindowVertex& b, double width, double depth_offset,
                    const Window& window, const FragmentCallback& take);

}  // namespace tessera::reference
