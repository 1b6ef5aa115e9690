#include "engine/program/imageio/ilbm.h"

#include <string_view>

namespace tessera::program {
namespace {

// View modes of the CAMG chunk.
constexpr std::uint32_t kHires = 0x8000, kLace = 0x0004;
constexpr int kHiresColumns = 640, kLaceRows = 400;  // from here on

// Integers of IFF are big-endian.
void append_u16(std::string& out, std::uint32_t value) {
  out += static_cast<char>(value >> 8 & 0xff);
  out += static_cast<char>(value & 0xff);
}
void append_u32(std::string& out, std::uint32_t value) {
  append_u16(out, value >> 16);
  append_u16(out, value & 0xffff);
}
// Chunks are padded to an even number of bytes, which their size does not count.
void append_chunk(std::string& out, std::string_view name, std::string_view content) {
  out += name;
  append_u32(out, static_cast<std::uint32_t>(content.size()));
  out += content;
  if (content.size() % 2 != 0) out += '\0';
}

std::string bitmap_header(const ScreenPicture& screen) {
  std::string out;
  append_u16(out, static_cast<std::uint32_t>(screen.width));
  append_u16(out, static_cast<std::uint32_t>(screen.height));
  append_u32(out, 0);  // position
  out += static_cast<char>(screen.bits);
  out += '\0';         // no mask plane
  out += '\1';         // ByteRun1
  out += '\0';         // padding
  append_u16(out, 0);  // transparent color: none, as there is no mask
  out += static_cast<char>(screen.pixel_aspect.numerator);
  out += static_cast<char>(screen.pixel_aspect.denominator);
  append_u16(out, static_cast<std::uint32_t>(screen.width));
  append_u16(out, static_cast<std::uint32_t>(screen.height));
  return out;
}

std::string color_map(const ScreenPicture& screen) {
  std::string out;
  for (const auto& entry : screen.palette)
    for (const std::uint8_t level : entry) out += static_cast<char>(level);
  return out;
}

/// Bit of a pixel that plane k holds. RGB planes: red from its lowest bit, then green, blue.
int bit_of_plane(const ScreenPicture& screen, int k) {
  return screen.bits == 24 ? 16 - k / 8 * 8 + k % 8 : k;
}

/// Row y of a plane, padded to 16 pixels.
std::string plane_row(const ScreenPicture& screen, int bit, int y) {
  std::string row(static_cast<std::size_t>((screen.width + 15) / 16 * 2), '\0');
  for (int x = 0; x < screen.width; ++x)
    if ((screen.pixel(x, y) >> bit & 1) != 0)
      row[static_cast<std::size_t>(x / 8)] |= static_cast<char>(0x80 >> x % 8);
  return row;
}

/// Number of equal bytes from `at` on, at most 128.
std::size_t run_length(std::string_view row, std::size_t at) {
  constexpr std::size_t kMaxRun = 128;
  std::size_t end = at + 1;
  while (end < row.size() && end - at < kMaxRun && row[end] == row[at]) ++end;
  return end - at;
}

// ByteRun1: n = 0..127: n + 1 bytes follow; n = -1..-127: the next byte 1 - n times.
void append_byte_run(std::string& out, std::string_view row) {
  constexpr std::size_t kMinRun = 3, kMaxLiterals = 128;
  for (std::size_t at = 0; at < row.size();) {
    if (const std::size_t run = run_length(row, at); run >= kMinRun) {
      out += static_cast<char>(257 - run);
      out += row[at];
      at += run;
      continue;
    }
    std::size_t end = at + 1;
    while (end < row.size() && end - at < kMaxLiterals && run_length(row, end) < kMinRun) ++end;
    out += static_cast<char>(end - at - 1);
    out += row.substr(at, end - at);
    at = end;
  }
}

}  // namespace

std::string encode_ilbm(const ScreenPicture& screen) {
  std::string body;
  for (int y = 0; y < screen.height; ++y)
    for (int k = 0; k < screen.bits; ++k)
      append_byte_run(body, plane_row(screen, bit_of_plane(screen, k), y));
  std::string view_mode;
  append_u32(view_mode,
             (screen.width >= kHiresColumns ? kHires : 0) | (screen.height >= kLaceRows ? kLace : 0));
  std::string chunks = "ILBM";
  append_chunk(chunks, "BMHD", bitmap_header(screen));
  if (!screen.palette.empty()) append_chunk(chunks, "CMAP", color_map(screen));
  append_chunk(chunks, "CAMG", view_mode);
  append_chunk(chunks, "BODY", body);
  std::string file;
  append_chunk(file, "FORM", chunks);
  return file;
}

}  // namespace tessera::program
