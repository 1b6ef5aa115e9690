// Shows numbers as colours.
#pragma once

#include <span>

#include "engine/program/imageio/picture.h"

namespace tessera::program {

/// Paints values from 0 to 1 in the colours of magma, from black over purple and orange to pale yellow.
/// - The colour of v is entry round(255 v) of the map, as in the error maps of FLIP's authors.
/// @param values  width * height values, rows from the top
Picture magma_picture(std::span<const float> values, int width, int height);

}  // namespace tessera::program
