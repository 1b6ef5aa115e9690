// PBM: black and white pictures of Netpbm.
#pragma once

#include <string>

#include "engine/program/imageio/screen_picture.h"

namespace tessera::program {

/// Returns the bytes of a binary PBM file, in which 1 is black.
/// @throws Error unless the picture has 1 bit per pixel and its colours are black and white
std::string encode_pbm(const ScreenPicture& screen);

}  // namespace tessera::program
