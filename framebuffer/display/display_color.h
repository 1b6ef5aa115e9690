// Light of displays in the primaries of the image.
#pragma once

#include "framebuffer/tessera/display.hpp"
#include "framebuffer/tessera/rgb_primaries.hpp"

namespace tessera::detail {

RgbPrimaries primaries_of(DisplayPrimaries primaries, DisplayWhite white);

/// Matrix from the light of a display to linear sRGB. XYZ stays the same, and white has Y = 1.
ColorMatrix srgb_from_display(DisplayPrimaries primaries, DisplayWhite white);

/// Linear sRGB of light 1 of a monochrome phosphor; Y = 1.
ColorValues srgb_from_phosphor(Phosphor phosphor);

bool is_monochrome(Phosphor phosphor);

/// Luma of levels or signals, .299 R' + .587 G' + .114 B' [BT.601]: what a monochrome display shows.
inline constexpr ColorValues kLuma{.299, .587, .114};

}  // namespace tessera::detail
