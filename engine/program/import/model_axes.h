// The vertical axis of models.
#pragma once

#include "engine/program/import/model.h"
#include "engine/program/scene/scene.h"

namespace tessera::program {

/// Turns a model, its cameras and its lights so that an axis of the file points up (+y). Components change
/// places and signs, so nothing is rounded.
void turn_up(UpAxis axis, Model& model);

}  // namespace tessera::program
