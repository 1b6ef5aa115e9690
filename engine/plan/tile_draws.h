// Draws in the form that tiles render: one TileDraw per plan, or one per polygon mode.
#pragma once

#include <span>
#include <vector>

#include "framebuffer/tessera/enums.hpp"
#include "shading/pixel_path.h"

namespace tessera::detail {

struct DrawPlan;
struct FrameBufferState;
struct FrameCommands;
struct RecordedDraw;

/// Modes in which the polygons of a plan are drawn, in the order of its tile draws.
/// Empty if all polygons are filled: the plan has one tile draw.
std::span<const PolygonMode> polygon_modes_of(const DrawPlan& plan);

/// Fills in `commands.tile_draws`, with the code path of each.
/// @pre the memory of the vertex stage is allocated
void build_tile_draws(FrameCommands& commands, const PixelPathFrame& frame);

/// The code paths of a planned draw, one per tile draw; empty if the draw can change no pixel.
/// Assumes that shading is deferred where possible, and the best instruction set of this machine.
std::vector<PixelPath> pixel_paths_of(const RecordedDraw& draw, const DrawPlan& plan,
                                      FrameBufferState& target);

}  // namespace tessera::detail
