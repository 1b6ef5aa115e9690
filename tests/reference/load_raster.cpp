// The commands bitmap and image, which draw pixels at a window position.
#include "scene_parts.h"

namespace tessera::reference {
namespace {

constexpr double kFarthest = 1 << 20;  // pixels

std::array<double, 2> parse_position(const Value& v) {
  if (array_size(v) != 2) fail(v.pointer, "x and y");
  return {number(v[0], -kFarthest, kFarthest), number(v[1], -kFarthest, kFarthest)};
}

// A number is the raster depth; anything else is a depth test, read by parse_fragment_state().
void parse_raster_depth(ObjectReader& reader, double& depth) {
  if (const Value v = reader.find("depth"); v && v.json->is_number()) depth = number(v, 0, 1);
}

unsigned hexadecimal_digit(char c, const Value& v) {
  if (c >= '0' && c <= '9') return static_cast<unsigned>(c - '0');
  if (c >= 'a' && c <= 'f') return static_cast<unsigned>(c - 'a' + 10);
  if (c >= 'A' && c <= 'F') return static_cast<unsigned>(c - 'A' + 10);
  fail(v.pointer, "hexadecimal digits", v.json->dump());
}

/// Rows from the top, whole bytes, most significant bit left.
std::vector<bool> parse_rows(const Value& v, int width, int height) {
  const auto columns = static_cast<std::size_t>(width);
  const auto count = static_cast<std::size_t>(height);
  const auto digits = (columns + 7) / 8 * 2;
  if (array_size(v) != count) fail(v.pointer, std::to_string(count) + " rows", std::to_string(array_size(v)));
  std::vector<bool> bits;
  for (std::size_t row = count; row-- > 0;) {
    const std::string line = text(v[row]);
    if (line.size() != digits)
      fail(v[row].pointer, std::to_string(digits) + " hexadecimal digits", v[row].json->dump());
    for (const char c : line) hexadecimal_digit(c, v[row]);
    for (std::size_t x = 0; x < columns; ++x)
      bits.push_back((hexadecimal_digit(line[x / 4], v[row]) >> (3 - x % 4) & 1) != 0);
  }
  return bits;
}

}  // namespace

Bitmap parse_bitmap(const Value& v, const FrameBufferFormat& format) {
  constexpr int kMaxSide = 16384;
  ObjectReader reader(v);
  Bitmap bitmap;
  bitmap.at = parse_position(reader.require("at"));
  parse_raster_depth(reader, bitmap.raster_depth);
  bitmap.width = static_cast<int>(integer(reader.require("width"), 1, kMaxSide));
  bitmap.height = static_cast<int>(integer(reader.require("height"), 1, kMaxSide));
  bitmap.bits = parse_rows(reader.require("rows"), bitmap.width, bitmap.height);
  if (const Value color = reader.find("color")) bitmap.color = vec4(color);
  parse_fragment_state(reader, format, bitmap);
  reader.finish();
  return bitmap;
}

ImageDrawing parse_image(const Value& v, const FrameBufferFormat& format, const std::string& directory) {
  ObjectReader reader(v);
  ImageDrawing drawing;
  drawing.at = parse_position(reader.require("at"));
  parse_raster_depth(reader, drawing.raster_depth);
  drawing.image = parse_image_file(reader.require("file"), directory);
  if (const Value zoom = reader.find("zoom")) drawing.zoom = numbers<2>(zoom);
  parse_fragment_state(reader, format, drawing);
  reader.finish();
  return drawing;
}

}  // namespace tessera::reference
