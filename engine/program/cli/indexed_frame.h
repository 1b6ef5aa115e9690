// Frames of few bits per pixel as indexed pictures.
#pragma once

#include "engine/program/imageio/picture.h"

namespace tessera::program::cli {

/// Returns whether frames of this format become PNG files of 1, 2, 4 or 8 bits per pixel: colour-index frames
/// of up to 8 bits, and grey frames of up to 2.
bool is_indexed(const FrameBufferFormat& format);

/// Reads the stored colours. Entries beyond the frame buffer's palette are black.
/// @throws Error if the last frame did not keep the colours
/// @pre is_indexed(buffer.format())
IndexedPicture indexed_picture(const FrameBuffer& buffer);

}  // namespace tessera::program::cli
