// PNG files [Portable Network Graphics (PNG) Specification, third edition, W3C 2025].
#pragma once

#include <string>

#include "engine/program/imageio/png_image.h"

namespace tessera::program {

/// Level without --compression. Of a teapot, textured models, dithers and a tube at 640x480 to 960x600, files
/// are 1 to 38 % smaller than those of zlib's level 3 with libpng's choice of filters, in a quarter to a
/// third of the time. Level 6 saves another 3 to 21 % in 1.4 to 2.6 times the time, level 9 3 to 31 % in 6 to
/// 20 times.
inline constexpr int kDefaultPngLevel = 3;

/// Returns the zlib stream of the filtered rows, the content of the file's IDAT chunks.
/// - Memory: once the bytes of the pixels, and the result.
/// @param level  0 (stored) .. 9 (smallest), or kDefaultCompression
std::string compress_pixels(const PngImage& image, int level);

/// Returns the bytes of a file.
std::string encode_png(const PngImage& image, int level);

}  // namespace tessera::program
