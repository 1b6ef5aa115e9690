// The draws as tiles see them: one TileDraw per plan, or one per polygon mode.
#pragma once

#include <span>

#include "framebuffer/tessera/enums.hpp"

namespace tessera::detail {

struct DrawPlan;
struct FrameCommands;

/// Modes in which the polygons of a plan are drawn, in the order of its tile draws. Empty: one tile draw,
/// filled.
std::span<const PolygonMode> polygon_modes_of(const DrawPlan& plan);

/// Fills in `commands.tile_draws`. @pre the memory of the vertex stage is allocated
void build_tile_draws(FrameCommands& commands);

}  // namespace tessera::detail
