// A scene around a model that comes alone: a camera that frames it, a light over the viewer's shoulder.
#pragma once

#include <string>

#include "engine/program/import/model.h"
#include "engine/program/scene/scene.h"

namespace tessera::program {

/// @param model   imported for display
/// @param name    the model's file, for messages
/// @param width   of the picture, as height: the camera keeps the model inside both
/// @throws Error for a model without extent.
Scene model_scene(Model model, const std::string& name, int width = 640, int height = 480);

}  // namespace tessera::program
