// Error diffusion over a finished frame: from the colours as drawn to the stored colours.
#pragma once

#include "engine/buffers/frame_buffer_state.h"
#include "framebuffer/scan_out.h"

namespace tessera::detail {

/// Takes the memory for diffuse_colors(). Throws std::bad_alloc; then the stored colours have not changed.
void reserve_diffused_colors(FrameBufferState& state);
/// Reduces the drawn colours to the stored ones. Never fails.
/// @param image     receives the picture that a display shows; null: none
/// @param scan_out  of the stored layout and the image's order; null without an image
/// @pre reserve_diffused_colors(); the drawn colours are defined
void diffuse_colors(FrameBufferState& state, const ImageTarget* image, const ScanOut* scan_out) noexcept;

}  // namespace tessera::detail
