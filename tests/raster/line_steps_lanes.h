// LineSteps as a plain function, compiled for every instruction set.
#pragma once

#include <utility>
#include <vector>

#include "framebuffer/instruction_set.h"
#include "framebuffer/tile_grid.h"
#include "raster/triangle_setup.h"

namespace tessera::test {
using namespace detail;

/// Appends the pixels of line i in `window` to pixels[i], in any order.
using PixelsOfLines = void(const TriangleGroup& lines, int width, const PixelRect& window,
                           std::vector<std::pair<int, int>> (&pixels)[kGroupSize]);
PixelsOfLines* pixels_of_lines(InstructionSet isa);

}  // namespace tessera::test
