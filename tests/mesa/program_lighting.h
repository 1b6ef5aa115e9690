// Lighting by GLSL programs.
#pragma once

#include <vector>

#include "programs.h"

namespace tessera::mesa {

/// Maximum number of lights of a program.
inline constexpr std::size_t kMaxProgramLights = 32;

/// Sets the uniforms of the current program for a lit draw. Two-sided lighting at the vertices needs
/// GL_VERTEX_PROGRAM_TWO_SIDE, which is set here, too. Lights are transformed to eye space by the camera.
void set_program_lighting(const Programs& programs, const reference::Draw& draw,
                          const reference::LightModel& model, const std::vector<reference::Light>& lights,
                          const reference::Camera& camera, bool has_vertex_colors);

}  // namespace tessera::mesa
