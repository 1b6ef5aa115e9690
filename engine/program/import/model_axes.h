// The vertical axis of models.
#pragma once

#include <string>

#include "engine/program/import/model.h"
#include "engine/program/scene/scene.h"

namespace tessera::program {

/// Returns the axis that points up in files of a format, by the extension of the name: z for 3MF (by its
/// specification, the axis across the layers of a print) and for SMD and VTA of the Source engine, else y.
UpAxis up_axis_of(const std::string& path);

/// Turns a model, its cameras and its lights so that an axis of the file points up (+y). Components change
/// places and signs, so nothing is rounded.
void turn_up(UpAxis axis, Model& model);

}  // namespace tessera::program
