// Light of the pixels of panels: liquid crystals, plasma, electronic paper.
#pragma once

#include <memory>

#include "framebuffer/display/light_source.h"
#include "framebuffer/tessera/display.hpp"
#include "framebuffer/tessera/screen.hpp"

namespace tessera::detail {

/// Planes: red, green, blue; paper has one, its reflectance over that of white.
/// @param frame_ms  from one frame of the mode to the next
std::unique_ptr<LightSource> make_panel_source(const Display& display, const VideoMode& mode,
                                               double frame_ms);

/// Light of each level of a liquid crystal panel in one frame, 1 for the highest.
/// @param phase  0 to 3: the threshold of temporal dither, if the panel has 6 bits
std::vector<float> lcd_light(const LcdPanel& panel, int phase);

/// Light of each level of a plasma panel: the nearest sum of subfields, 1 for all of them.
/// @param from_share, to_share  the exposure as shares of the frame; the sum is collected within
std::vector<float> plasma_light(const PlasmaPanel& panel, double from_share, double to_share);

/// Reflectance over that of white of each level of luma.
std::vector<float> paper_light(const EinkPanel& panel);

}  // namespace tessera::detail
