// The module libtessera_imageio, loaded on first need: beside the running program, in ../lib from there, or
// where the system looks for libraries; once found it stays loaded. Each function throws Error: where the
// module is missing, by its name; and with what the module says.
#pragma once

#include <string>
#include <vector>

#include "engine/program/imageio/picture.h"

namespace tessera::program {

/// The bytes of an image file.
/// @param ending  of the file, in lower case with its dot: the format
/// @param compression  of PNG, 0 .. 9, or kDefaultCompression
std::string encode_by_module(const Picture& picture, const std::string& ending, int compression);

/// The bytes of a PNG file.
std::string encode_indexed_by_module(const IndexedPicture& picture, int compression);

Picture decode_by_module(const std::string& file, const std::string& ending);

}  // namespace tessera::program
