// Chunks of PNG files [PNG, 5 and 11]. Each function appends to the bytes of a file.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "engine/program/imageio/png_image.h"

namespace tessera::program {

/// Largest number of bytes in a chunk of pixel data. Readers need not hold more of it at a time.
inline constexpr std::size_t kMaxPngDataBytes = std::size_t{1} << 20;

/// Appends a number of 2 or 4 bytes, the high byte first.
void append_u16(std::uint32_t value, std::string& bytes);
void append_u32(std::uint32_t value, std::string& bytes);

/// @param type  four letters
void append_chunk(std::string_view type, std::string_view data, std::string& file);

/// Signature and IHDR.
void append_png_header(const PngFormat& format, std::string& file);
/// PLTE; nothing without entries.
void append_palette(const std::vector<std::uint8_t>& palette, std::string& file);
/// IDAT: compressed pixels, in chunks of at most kMaxPngDataBytes.
void append_pixel_data(std::string_view data, std::string& file);

}  // namespace tessera::program
