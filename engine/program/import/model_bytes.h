// Serializes a model for the pipe from the process that read it.
#pragma once

#include <string>

#include "engine/program/import/model.h"

namespace tessera::program {

std::string to_bytes(const Model& model);

/// @param path  the model's file, for messages
/// @throws Error, naming the file, for bytes that do not hold a valid model: the process that sent them may
///   have crashed
Model model_from_bytes(const std::string& bytes, const std::string& path);

}  // namespace tessera::program
