// A model as bytes, on its way out of the process that read it.
#pragma once

#include <string>

#include "engine/import/model.h"

namespace tessera {

std::string to_bytes(const Model& model);
/// @throws Error for bytes that to_bytes() did not make.
Model model_from_bytes(const std::string& bytes);

}  // namespace tessera
