#include "tests/engine/program/imageio/png_reader.h"

#include <cstring>
#include <stdexcept>

#include <png.h>

namespace tessera {
namespace {

struct Source {
  const std::string& file;
  std::size_t at = 0;
};

void read(png_structp png, png_bytep to, std::size_t count) {
  auto& source = *static_cast<Source*>(png_get_io_ptr(png));
  if (source.file.size() - source.at < count) png_error(png, "the file ends too early");
  std::memcpy(to, source.file.data() + source.at, count);
  source.at += count;
}

[[noreturn]] void fail(png_structp, png_const_charp message) { throw std::runtime_error(message); }
void fail_on_warning(png_structp, png_const_charp message) { throw std::runtime_error(message); }

}  // namespace

DecodedPng read_by_libpng(const std::string& file) {
  Source source{file};
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, fail, fail_on_warning);
  png_infop info = png_create_info_struct(png);
  png_set_read_fn(png, &source, read);
  png_read_info(png, info);
  DecodedPng decoded{.width = static_cast<int>(png_get_image_width(png, info)),
                     .height = static_cast<int>(png_get_image_height(png, info)),
                     .bits = png_get_bit_depth(png, info),
                     .color = png_get_color_type(png, info)};
  png_colorp colors = nullptr;
  int entries = 0;
  if (png_get_PLTE(png, info, &colors, &entries) != 0)
    for (int i = 0; i < entries; ++i)
      decoded.palette.insert(decoded.palette.end(), {colors[i].red, colors[i].green, colors[i].blue});
  decoded.rows.assign(static_cast<std::size_t>(decoded.height),
                      std::vector<std::uint8_t>(png_get_rowbytes(png, info)));
  for (auto& row : decoded.rows) png_read_row(png, row.data(), nullptr);
  png_read_end(png, info);
  png_destroy_read_struct(&png, &info, nullptr);
  return decoded;
}

}  // namespace tessera
