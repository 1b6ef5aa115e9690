// Lighting by OpenGL's fixed-function pipeline.
#pragma once

#include <vector>

#include "tests/reference/scene.h"
#include "vertex_list.h"

namespace tessera::mesa {

/// Whether the fixed-function pipeline computes what the specification requires of this draw.
bool fixed_functions_can(const reference::Draw& draw, const reference::LightModel& model,
                         const std::vector<reference::Light>& lights, const reference::Camera& camera,
                         const std::vector<Vertex>& vertices);

/// Sets lights, light model, materials and colour material. The model view matrix must hold the view only:
/// OpenGL transforms positions and spot directions of lights by it.
void set_fixed_function_lighting(const reference::Draw& draw, const reference::LightModel& model,
                                 const std::vector<reference::Light>& lights, bool has_vertex_colors);

}  // namespace tessera::mesa
