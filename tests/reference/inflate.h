// Decompression of zlib data (RFC 1950 and 1951) as in PNG files. Checksums are not verified.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace tessera::reference {

/// @throws std::runtime_error for data that is broken or truncated.
std::vector<std::uint8_t> inflate(std::span<const std::uint8_t> zlib);

}  // namespace tessera::reference
