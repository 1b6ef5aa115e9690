// Calls the module libtessera_imageio, which is loaded on first use (loaded_module.h) and stays loaded. Each
// function throws Error if the module is missing, and with the module's own message if it fails.
#pragma once

#include <string>
#include <vector>

#include "engine/program/imageio/picture.h"

namespace tessera::program {

/// Returns the bytes of an image file.
/// @param extension  selects the format; in lower case with its dot
/// @param channels   3: without alpha; 4
std::string encode_by_module(const Picture& picture, const std::string& extension, int channels);

/// Decodes the bytes of an image file.
Picture decode_by_module(const std::string& file, const std::string& extension);

}  // namespace tessera::program
