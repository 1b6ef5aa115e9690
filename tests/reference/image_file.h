// Reads binary portable pixmaps and graymaps, and PNG.
#pragma once

#include <string>
#include <vector>

#include "scene.h"

namespace tessera::reference {

/// Detects the format by content, not by file name.
/// @throws std::runtime_error for a file that is missing, broken or of another kind. The message completes
///     "found ...".
Image read_image(const std::string& path);

/// One channel of a pixel in 8 bits: the nearest level, without a transfer curve.
std::uint8_t level_in_8_bits(unsigned value, unsigned largest);

/// @param bytes  the whole file
Image read_png(const std::vector<std::uint8_t>& bytes);

}  // namespace tessera::reference
