// The draws as tiles see them: one TileDraw per plan, or one per polygon mode.
#pragma once

#include <span>

#include "framebuffer/tessera/enums.hpp"

namespace tessera::detail {

struct DrawPlan;
struct FrameCommands;
struct PixelPathFrame;

/// Modes in which the polygons of a plan are drawn, in the order of its tile draws. Empty: one tile draw,
/// filled.
std::span<const PolygonMode> polygon_modes_of(const DrawPlan& plan);

/// Fills in `commands.tile_draws`, with the code path of each. @pre the memory of the vertex stage is
/// allocated
void build_tile_draws(FrameCommands& commands, const PixelPathFrame& frame);

}  // namespace tessera::detail
