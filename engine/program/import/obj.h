// Wavefront OBJ with its MTL materials.
#pragma once

#include <string>

#include "engine/program/import/model.h"

namespace tessera::program {

/// Reads the model in this process.
/// @throws Error, naming the file and if possible the line
Model import_obj(const std::string& path);

}  // namespace tessera::program
