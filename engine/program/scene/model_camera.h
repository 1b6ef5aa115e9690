// The camera of a model's scene.
#pragma once

#include <optional>

#include "engine/program/import/model.h"
#include "engine/program/scene/scene.h"

namespace tessera::program {

/// Returns the first camera of the file that shows any of the model; empty: none does.
std::optional<SceneCamera> camera_of_file(const Model& model, double aspect);

/// Sets the scene's camera: the first camera of the file that shows any of the model; if none does, one that
/// frames the model, with a warning if the file has cameras.
/// @param all_sides  frames the model so that it fits however it turns around its vertical axis, and ignores
///                   the cameras of the file
/// @throws Error for a model without extent
void choose_camera(const Model& model, double aspect, bool all_sides, Scene& scene);

}  // namespace tessera::program
