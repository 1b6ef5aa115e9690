// Decodes the images of a model's textures.
#pragma once

#include <string>

#include "engine/program/import/model.h"

namespace tessera::program {

/// Decodes all images that parts use, in the calling process; import_model() runs it in a child process.
/// - Files are searched in the model's folder: the name as it is, with backslashes as slashes, as a relative
///   path, without its folders, and likewise in lower case, because models often come from systems that
///   ignore it. A picture without a name has that of the model.
/// - An image that cannot be read or decoded becomes a warning, and its parts lose their texture.
/// - Images and textures that no part uses are removed.
void decode_images(const std::string& model_path, Model& model);

}  // namespace tessera::program
