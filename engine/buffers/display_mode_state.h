// Parts of display modes that their table and their parameters share.
#pragma once

#include <vector>

#include "engine/tessera/display_mode.hpp"
#include "framebuffer/palette.h"

namespace tessera::detail {

/// numerator : denominator in lowest terms. @pre both above 0
AspectRatio lowest_terms(int numerator, int denominator);

/// Entries of 8 bits per component as components of 0 to 1.
std::vector<Color> colors_of(const std::vector<Rgb8>& entries);

/// Checks that the values of a mode fit together.
/// @param function  named in errors
void check_display_mode(const DisplayMode& mode, const char* function);

}  // namespace tessera::detail
