// The named user stages of scenes, on corners and on fragments.
#pragma once

#include "scene.h"
#include "shade.h"
#include "vertex_stage.h"
#include "window.h"

namespace tessera::reference {

/// Whether a stage makes vertex colours.
bool makes_vertex_colors(const Draw& draw);

/// Runs the stages of a draw on the corner of an object-space position.
void run_stages(const Draw& draw, const Mesh& mesh, Vec4 object, Corner& corner);

/// The colours of a fragment after the stages.
/// @param world  position of the fragment in world space
Shade staged_color(const Draw& draw, const FrameBufferFormat& format, const Fragment& fragment, Vec3 world,
                   Shade shade);

/// The fragment with the depths of the stages; none if they discard it.
std::optional<Fragment> staged_fragment(const Draw& draw, const FrameBufferFormat& format, Fragment fragment);

}  // namespace tessera::reference
