// The colours that lit materials can have.
#pragma once

#include <vector>

#include "engine/tessera/palettes.hpp"
#include "framebuffer/ramp_palette.h"

namespace tessera::detail {

/// Appends the ramps of all materials of a group: for each light alone, and for all of them.
/// @throws Error  for values that are not finite
void append_material_ramps(const LitMaterials& group, const char* function, std::vector<ColorRamp>& ramps);

}  // namespace tessera::detail
