// The chunks of a PNG file, read with code that the writer does not share.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

namespace tessera {

struct PngChunk {
  std::string type;
  std::string data;
};

/// A number of 2 or 4 bytes, the high byte first.
inline std::uint32_t big_endian(const std::string& bytes, std::size_t at, std::size_t count) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < count; ++i) value = value << 8 | static_cast<std::uint8_t>(bytes.at(at + i));
  return value;
}

/// CRC bit by bit [PNG, annex D].
inline std::uint32_t png_crc(const std::string& bytes) {
  std::uint32_t crc = 0xffffffffu;
  for (const char byte : bytes) {
    crc ^= static_cast<std::uint8_t>(byte);
    for (int bit = 0; bit < 8; ++bit) crc = (crc & 1) != 0 ? crc >> 1 ^ 0xedb88320u : crc >> 1;
  }
  return ~crc;
}

/// Checks signature, lengths, CRCs and that nothing follows IEND.
inline std::vector<PngChunk> png_chunks(const std::string& file) {
  std::vector<PngChunk> chunks;
  if (file.substr(0, 8) != "\x89PNG\r\n\x1a\n") {
    ADD_FAILURE() << "no signature";
    return chunks;
  }
  for (std::size_t at = 8; at < file.size();) {
    const std::size_t length = file.size() - at < 12 ? file.size() : big_endian(file, at, 4);
    if (length > file.size() - at - 12) {
      ADD_FAILURE() << "a chunk is cut off at byte " << at;
      return chunks;
    }
    chunks.push_back({file.substr(at + 4, 4), file.substr(at + 8, length)});
    EXPECT_EQ(png_crc(file.substr(at + 4, 4 + length)), big_endian(file, at + 8 + length, 4))
        << chunks.back().type << " at byte " << at;
    EXPECT_TRUE(at == 8 || chunks.back().type != "IHDR");
    at += 12 + length;
    EXPECT_EQ(chunks.back().type == "IEND", at == file.size());
  }
  return chunks;
}

/// Their types, separated by spaces.
inline std::string types_of(const std::vector<PngChunk>& chunks) {
  std::string types;
  for (const PngChunk& chunk : chunks) types += (types.empty() ? "" : " ") + chunk.type;
  return types;
}

}  // namespace tessera
