// ILBM: bitplane pictures in IFF files, the format of the Amiga.
#pragma once

#include <string>

#include "engine/program/imageio/screen_picture.h"

namespace tessera::program {

/// Returns the bytes of an ILBM file, compressed by ByteRun1.
/// - Indices: as many planes as bits, with a colour map. RGB: 24 planes, red first.
/// Source: EA IFF 85, ILBM interleaved bitmap.
std::string encode_ilbm(const ScreenPicture& screen);

}  // namespace tessera::program
