// Makes a scene of a single model: its own camera and lights, or a camera that frames it and a light over the
// viewer's shoulder.
#pragma once

#include <string>

#include "engine/program/import/model.h"
#include "engine/program/scene/scene.h"

namespace tessera::program {

/// @param model   imported for display
/// @param name    the model's file, for messages
/// @param width, height  of the picture that a default camera fits the model into
/// @param all_sides      the camera shows all of the model however it turns; see choose_camera()
/// @throws Error for a model without extent
Scene model_scene(Model model, const std::string& name, int width = 640, int height = 480,
                  bool all_sides = false);

}  // namespace tessera::program
