// Wavefront OBJ with its MTL materials.
#pragma once

#include <string>

#include "engine/program/import/model.h"

namespace tessera::program {

/// In this process; `files` are names, from the folder of the model. @throws Error, naming the file and where
/// possible the line.
Model import_obj(const std::string& path);

}  // namespace tessera::program
