// Files with the display memory of a picture.
#pragma once

#include <string>

#include "engine/tessera/display_mode.hpp"
#include "engine/tessera/tessera.hpp"

namespace tessera::program::cli {

/// Writes the stored picture as ILBM (.iff, .ilbm, .lbm) or PCX (.pcx); with any other extension as the bytes
/// of the mode's memory.
/// @param buffer  a frame buffer of the mode that kept its colours
/// @throws Error
void write_memory_dump(const FrameBuffer& buffer, const DisplayMode& mode, const std::string& path);

}  // namespace tessera::program::cli
