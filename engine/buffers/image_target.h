// Checks and regions of image targets.
#pragma once

#include "engine/tessera/tessera.hpp"
#include "framebuffer/tile_grid.h"

namespace tessera::detail {

/// Checks the target of Renderer::finish().
/// @throws Error  if the target does not fit the format
void check_image_target(const ImageTarget& target, const FrameBufferFormat& format);

/// Bytes from a row to the one below.
inline std::ptrdiff_t row_stride(const ImageTarget& target) {
  return target.stride_bytes != 0 ? target.stride_bytes : std::ptrdiff_t{4} * target.width;
}

/// Pixels of a checked target that are written, in raster space.
PixelRect target_region(const ImageTarget& target);

}  // namespace tessera::detail
