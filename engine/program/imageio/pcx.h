// PCX: run-length coded pictures of PC paint programs.
#pragma once

#include <string>

#include "engine/program/imageio/screen_picture.h"

namespace tessera::program {

/// Returns the bytes of a PCX file of version 5.
/// - Up to 4 bits: one plane of 1 bit per bit of an index, and the palette of 16 entries in the header. A
/// file
///   of one plane is black and white, so 2 entries of other colours take two planes.
/// - 5 to 8 bits: bytes, and a palette of 256 entries at the end. RGB: three planes of bytes.
/// Source: ZSoft PCX File Format Technical Reference Manual, 1991.
std::string encode_pcx(const ScreenPicture& screen);

}  // namespace tessera::program
