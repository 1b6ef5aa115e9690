// A model as bytes, on its way out of the process that read it.
#pragma once

#include <string>

#include "engine/program/import/model.h"

namespace tessera::program {

std::string to_bytes(const Model& model);
/// @throws Error, naming the file, for bytes that no sound model becomes: they may come from a process that
/// broke.
Model model_from_bytes(const std::string& bytes, const std::string& path);

}  // namespace tessera::program
