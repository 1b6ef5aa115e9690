// The camera of a model's scene.
#pragma once

#include "engine/program/import/model.h"
#include "engine/program/scene/scene.h"

namespace tessera::program {

/// Sets the scene's camera: the first camera of the file that shows any of the model; if none does, one that
/// frames the model, with a warning if the file has cameras.
/// @throws Error for a model without extent
void choose_camera(const Model& model, double aspect, Scene& scene);

}  // namespace tessera::program
