// Checks of the caller's image memory.
#pragma once

#include "engine/tessera/tessera.hpp"
#include "framebuffer/tile_grid.h"

namespace tessera::detail {

/// Throws Error where the target cannot take a picture of that format.
void check_image_target(const ImageTarget& target, const FrameBufferFormat& format);

/// The pixels of a checked target that are to be written, rows counted from the top.
PixelRect target_region(const ImageTarget& target);

}  // namespace tessera::detail
