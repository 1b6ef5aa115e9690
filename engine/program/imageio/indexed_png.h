// Encodes PNG files of 1, 2, 4 or 8 bits per pixel with libpng; OpenImageIO writes 8 bits per component only.
#pragma once

#include <string>
#include <vector>

namespace tessera::program {

/// Appends a PNG file to `file`.
/// @param indices          one byte per pixel, rows from the top
/// @param palette          3 bytes per entry
/// @param palette_entries  0: a grey picture without a palette
/// @param compression      0 .. 9
/// @return the error; empty: success
std::string encode_indexed_png(const unsigned char* indices, int width, int height, int bits,
                               const unsigned char* palette, int palette_entries, int compression,
                               std::vector<unsigned char>& file);

}  // namespace tessera::program
