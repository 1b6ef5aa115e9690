// Palettes that are chosen for a scene: for its picture at 24 bits, or for its materials and lights.
#pragma once

#include <vector>

#include "engine/program/imageio/picture.h"
#include "engine/program/scene/ramp_colors.h"
#include "engine/program/scene/scene.h"

namespace tessera::program {

/// Size and colours of the palette of a scene's picture.
/// @throws Error for a mode whose palette cannot be chosen
PaletteRequest scene_palette_request(const Scene& scene);

/// @throws Error if the source of the palette cannot serve these pictures
void check_palette_over(const Scene& scene);

/// @throws Error for a scene that stores palette indices, which have no colours before there is a palette
void check_stores_colors(const Scene& scene);

/// Draws the scene at 24 bits, without dither: the picture that an adaptive palette is chosen for.
/// @throws Error as check_stores_colors()
Picture picture_for_palette(const Scene& scene, Renderer& renderer);

/// Chooses the palette of a scene's picture. @pre scene.palette_source is not given
/// @throws Error as check_stores_colors()
std::vector<Color> choose_palette(const Scene& scene, Renderer& renderer);

}  // namespace tessera::program
