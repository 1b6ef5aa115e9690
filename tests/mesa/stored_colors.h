// Displayed colours of a frame buffer of few bits or with a palette, from unquantized colours.
#pragma once

#include <cstdint>
#include <vector>

#include "tests/reference/scene.h"

namespace tessera::mesa {

/// @param colors  red, green and blue of each pixel, rows from the bottom, 0..1 (clamped here)
/// @return 3 bytes per pixel, rows from the top
std::vector<std::uint8_t> shown_colors(const std::vector<float>& colors,
                                       const reference::FrameBufferFormat& format);

}  // namespace tessera::mesa
