// Checks and regions of image targets, of captures and of read-back.
#pragma once

#include <cstddef>
#include <optional>

#include "engine/tessera/tessera.hpp"
#include "framebuffer/tile_grid.h"

namespace tessera::detail {

/// Checks the target of a function.
/// @throws Error  if the target does not fit the format
void check_image_target(const ImageTarget& target, const FrameBufferFormat& format, const char* function);

/// Bytes from a row to the one below.
inline std::ptrdiff_t row_stride(const ImageTarget& target) {
  return target.stride_bytes != 0 ? target.stride_bytes : std::ptrdiff_t{4} * target.width;
}

/// Pixels of a checked target that are written, in raster space.
PixelRect target_region(const ImageTarget& target);

/// Pixels of a region that spans hold, in raster space; absent: the frame buffer.
/// @throws Error  if the region is not in the frame buffer
PixelRect pixels_of_region(const std::optional<Rect>& region, const FrameBufferFormat& format,
                           const char* function);

}  // namespace tessera::detail
