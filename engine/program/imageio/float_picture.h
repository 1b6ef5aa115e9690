// Pictures of floats as PFM files.
#pragma once

#include <span>
#include <string>

namespace tessera::program {

/// Returns the bytes of a PFM file with 1 or 3 floats per pixel.
/// - `values`: width * height * channels floats, rows from the top. The rows of the file run from the bottom.
std::string encode_pfm(int width, int height, int channels, std::span<const float> values);

}  // namespace tessera::program
