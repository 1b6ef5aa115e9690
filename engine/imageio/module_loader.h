// The module libtessera_imageio, loaded on first need.
#pragma once

#include <string>

#include "engine/imageio/picture.h"

namespace tessera {

/// The bytes of an image file. Looks for the module beside the running program, in ../lib from there, then where the system
/// looks for libraries; once found it stays loaded.
///
/// @param ending  of the file, in lower case with its dot: the format
/// @throws Error, naming the module, if it is not there, and for a format that OpenImageIO does not write.
std::string encode_by_module(const Picture& picture, const std::string& ending);

}  // namespace tessera
