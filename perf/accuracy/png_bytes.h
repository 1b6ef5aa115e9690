// PNG files in memory.
#pragma once

#include <cstdint>
#include <string>

#include "engine/program/imageio/picture.h"

namespace tessera::accuracy {

enum class PngEffort { fast, small };

/// Encodes red, green and blue of a picture, 8 bits per component.
std::string png_bytes(const program::Picture& picture, PngEffort effort);

/// Text of bytes in base64 [RFC 4648, section 4], for data URIs.
std::string base64(std::string_view bytes);

}  // namespace tessera::accuracy
