// Lighting by programs.
#pragma once

#include <vector>

#include "programs.h"

namespace tessera::mesa {

/// As many lights as a program takes.
inline constexpr std::size_t kMaxProgramLights = 32;

/// Tells the program in use of a lit draw. Two-sided lighting at the vertices wants
/// GL_VERTEX_PROGRAM_TWO_SIDE, which this sets too. Lights go into eye space by the camera.
void set_program_lighting(const Programs& programs, const reference::Draw& draw,
                          const reference::LightModel& model, const std::vector<reference::Light>& lights,
                          const reference::Camera& camera, bool has_vertex_colors);

}  // namespace tessera::mesa
