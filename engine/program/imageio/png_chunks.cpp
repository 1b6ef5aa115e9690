#include "engine/program/imageio/png_chunks.h"

#include <libdeflate.h>

namespace tessera::program {

void append_u16(std::uint32_t value, std::string& bytes) {
  for (const int shift : {8, 0}) bytes += static_cast<char>(value >> shift & 0xff);
}

void append_u32(std::uint32_t value, std::string& bytes) {
  for (const int shift : {24, 16, 8, 0}) bytes += static_cast<char>(value >> shift & 0xff);
}

// Length of the data, type, data, CRC of type and data [PNG, 5.3].
void append_chunk(std::string_view type, std::string_view data, std::string& file) {
  append_u32(static_cast<std::uint32_t>(data.size()), file);
  file += type;
  file += data;
  const std::uint32_t crc = libdeflate_crc32(0, type.data(), type.size());
  append_u32(libdeflate_crc32(crc, data.data(), data.size()), file);
}

void append_png_header(const PngFormat& format, std::string& file) {
  file += "\x89PNG\r\n\x1a\n";
  std::string header;
  append_u32(static_cast<std::uint32_t>(format.width), header);
  append_u32(static_cast<std::uint32_t>(format.height), header);
  header += static_cast<char>(format.bits);
  header += static_cast<char>(format.color);
  header.append(3, '\0');  // deflate, the five filters, no interlacing
  append_chunk("IHDR", header, file);
}

void append_palette(const std::vector<std::uint8_t>& palette, std::string& file) {
  if (!palette.empty())
    append_chunk("PLTE", {reinterpret_cast<const char*>(palette.data()), palette.size()}, file);
}

void append_pixel_data(std::string_view data, std::string& file) {
  for (std::size_t at = 0; at < data.size(); at += kMaxPngDataBytes)
    append_chunk("IDAT", data.substr(at, kMaxPngDataBytes), file);
}

}  // namespace tessera::program
