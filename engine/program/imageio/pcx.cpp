#include "engine/program/imageio/pcx.h"

#include <string_view>

namespace tessera::program {
namespace {

constexpr std::size_t kHeaderBytes = 128;
constexpr std::size_t kHeaderEntries = 16;

/// Planes of a row, and the bits of a pixel in each.
struct PlaneFormat {
  int planes, bits;
};
PlaneFormat plane_format(const ScreenPicture& screen) {
  if (screen.bits == 24) return {3, 8};
  if (screen.bits > 4) return {1, 8};
  const bool is_black_and_white = screen.bits == 1 && screen.palette[0] == std::array<std::uint8_t, 3>{} &&
                                  screen.palette[1] == std::array<std::uint8_t, 3>{255, 255, 255};
  return {screen.bits == 1 && !is_black_and_white ? 2 : screen.bits, 1};
}

// Integers of PCX are little-endian.
void append_word(std::string& out, int value) {
  out += static_cast<char>(value & 0xff);
  out += static_cast<char>(value >> 8 & 0xff);
}
void append_entries(std::string& out, const ScreenPicture& screen, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t c = 0; c < 3; ++c)
      out += static_cast<char>(i < screen.palette.size() ? screen.palette[i][c] : 0);
}

/// Rows of a plane take an even number of bytes.
std::size_t row_bytes(const ScreenPicture& screen, const PlaneFormat& format) {
  return (static_cast<std::size_t>(screen.width) * static_cast<std::size_t>(format.bits) + 15) / 16 * 2;
}

std::string pcx_header(const ScreenPicture& screen, const PlaneFormat& format) {
  std::string out = "\x0a\x05\x01";  // manufacturer, version 3.0 with palette, run-length coding
  out += static_cast<char>(format.bits);
  for (const int edge : {0, 0, screen.width - 1, screen.height - 1}) append_word(out, edge);
  append_word(out, screen.width);  // resolution
  append_word(out, screen.height);
  append_entries(out, screen, kHeaderEntries);
  out += '\0';
  out += static_cast<char>(format.planes);
  append_word(out, static_cast<int>(row_bytes(screen, format)));
  append_word(out, 1);  // the palette holds colours
  out.resize(kHeaderBytes);
  return out;
}

std::string plane_of_row(const ScreenPicture& screen, const PlaneFormat& format, int plane, int y) {
  std::string row(row_bytes(screen, format), '\0');
  for (int x = 0; x < screen.width; ++x) {
    const std::uint32_t pixel = screen.pixel(x, y);
    const auto column = static_cast<std::size_t>(x);
    // RGB: plane 0 is red, the highest byte.
    if (format.bits == 8) row[column] = static_cast<char>(pixel >> 8 * (format.planes - 1 - plane) & 0xff);
    else if ((pixel >> plane & 1) != 0) row[column / 8] |= static_cast<char>(0x80 >> x % 8);
  }
  return row;
}

// Bytes from C0h on hold a count in their low 6 bits; the value follows.
void append_runs(std::string& out, std::string_view row) {
  constexpr std::size_t kMaxCount = 63;
  constexpr unsigned char kCountMark = 0xc0;
  for (std::size_t at = 0; at < row.size();) {
    std::size_t count = 1;
    while (count < kMaxCount && at + count < row.size() && row[at + count] == row[at]) ++count;
    if (count > 1 || static_cast<unsigned char>(row[at]) >= kCountMark)
      out += static_cast<char>(kCountMark | count);
    out += row[at];
    at += count;
  }
}

}  // namespace

std::string encode_pcx(const ScreenPicture& screen) {
  const PlaneFormat format = plane_format(screen);
  std::string file = pcx_header(screen, format);
  for (int y = 0; y < screen.height; ++y)
    for (int plane = 0; plane < format.planes; ++plane)
      append_runs(file, plane_of_row(screen, format, plane, y));
  if (format.planes == 1 && format.bits == 8) {
    file += '\x0c';
    append_entries(file, screen, 256);
  }
  return file;
}

}  // namespace tessera::program
