// PNG of 1, 2, 4 and 8 bits a pixel, by libpng: OpenImageIO writes all of them with 8 bits a component.
#pragma once

#include <string>
#include <vector>

namespace tessera::program {

/// Appends a PNG file to `file`: indices into the palette's colours of 3 bytes, or greys where it has no
/// entries. Returns what went wrong, or nothing.
std::string encode_indexed_png(const unsigned char* indices, int width, int height, int bits,
                               const unsigned char* palette, int palette_entries, int compression,
                               std::vector<unsigned char>& file);

}  // namespace tessera::program
