// Checks of the caller's image memory.
#pragma once

#include "engine/tessera/tessera.hpp"

namespace tessera {

/// Throws Error where the target cannot take a picture of that format.
void check_image_target(const ImageTarget& target, const FrameBufferFormat& format);

}  // namespace tessera
