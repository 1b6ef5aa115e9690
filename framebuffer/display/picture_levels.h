// Stored pixels -> levels.
#pragma once

#include <cstdint>
#include <vector>

#include "framebuffer/tessera/screen.hpp"

namespace tessera::detail {

/// Rows of levels of 8 bits: red, green, blue, without gaps.
/// @throws DisplayError  for a picture that does not have this size
std::vector<std::uint8_t> read_levels(const VideoPicture& picture, int width, int height);

}  // namespace tessera::detail
