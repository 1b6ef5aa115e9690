// Checks of the modes that callers give.
#pragma once

#include "framebuffer/tessera/screen.hpp"

namespace tessera::detail {

/// @throws DisplayError  for sizes, aspects and timings out of range, and timings too short for the pixels
void check_mode(const VideoMode& mode);

}  // namespace tessera::detail
