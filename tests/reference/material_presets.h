// The named materials of the lighting reference.
#pragma once

#include <string>

#include "scene.h"

namespace tessera::reference {

/// @param name  a name of the table with underscores, as "polished_gold"
/// @throws std::runtime_error for any other name.
Material material_preset(const std::string& name);

}  // namespace tessera::reference
