// Layouts of display memory: where the bits of a pixel lie in the memory of an adapter.
#pragma once

#include <cstdint>

namespace tessera {

/// Arrangement of the pixels of a display mode in its memory. Rows run from the top of the picture.
/// Rows of packed pixels and of planes end at a byte; unused bits and the gaps between banks are 0.
enum class MemoryLayout : std::uint8_t {
  packed,           ///< 1, 2, 4 or 8 bits: whole pixels in a byte, the leftmost in the high bits
  cga_banks,        ///< packed; row y begins at (y & 1) * 8192 + (y >> 1) * bytes per row; 16,384 bytes
  hercules_banks,   ///< packed; row y begins at (y & 3) * 8192 + (y >> 2) * bytes per row; 32,768 bytes
  planes,           ///< one 1-bit image per bit of a pixel, plane 0 (the lowest bit) first, bit 7 leftmost
  byte_planes,      ///< 8 bits: pixel (x, y) is a byte of plane x & 3, at y * (width / 4) + (x >> 2)
  bytes,            ///< a whole number of bytes per pixel, in a ByteOrder; unused high bits are 0
  character_cells,  ///< character codes and attributes. Pixels cannot be stored
};

/// Order of the bytes of a pixel that takes several.
enum class ByteOrder : std::uint8_t { little, big };

}  // namespace tessera
