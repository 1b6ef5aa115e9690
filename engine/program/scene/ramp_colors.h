// The colours that a scene can have, gathered before it is drawn: the input of ramp_palette().
#pragma once

#include <vector>

#include "engine/program/scene/scene.h"

namespace tessera::program {

struct RampColors {
  std::vector<LitMaterials> groups;
  std::vector<Color> colors;
};

/// Adds the colours of a scene: lit materials, also with vertex colours and textures; unlit draws, shadows,
/// clears, bitmaps and images.
/// - Vertex colours, textures and images count with the few colours of their adaptive palettes.
/// - Blending, logic operations and masks are ignored.
void add_ramp_colors(const Scene& scene, Renderer& renderer, RampColors& ramps);

}  // namespace tessera::program
