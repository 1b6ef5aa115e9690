#include "engine/program/imageio/indexed_png.h"

#include <csetjmp>
#include <cstddef>
#include <cstdint>

#include <png.h>

namespace tessera::program {
namespace {

struct Writer {
  std::vector<unsigned char>& file;
  std::string error;
};

void append(png_structp png, png_bytep bytes, std::size_t count) {
  auto& file = static_cast<Writer*>(png_get_io_ptr(png))->file;
  file.insert(file.end(), bytes, bytes + count);
}
void no_flush(png_structp) {}
[[noreturn]] void fail(png_structp png, png_const_charp message) {
  static_cast<Writer*>(png_get_error_ptr(png))->error = std::string("libpng: ") + message;
  longjmp(png_jmpbuf(png), 1);
}
void ignore_warning(png_structp, png_const_charp) {}

// libpng reports errors by longjmp, so no local variable here may have a destructor.
void write(png_structp png, png_infop info, const unsigned char* indices, int width, int height, int bits,
           const unsigned char* palette, int entries, int compression, unsigned char* row) {
  if (setjmp(png_jmpbuf(png)) != 0) return;
  png_set_compression_level(png, compression);
  png_set_IHDR(png, info, static_cast<png_uint_32>(width), static_cast<png_uint_32>(height), bits,
               entries > 0 ? PNG_COLOR_TYPE_PALETTE : PNG_COLOR_TYPE_GRAY, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  if (entries > 0) {
    png_color colors[256];
    for (int i = 0; i < entries; ++i) colors[i] = {palette[3 * i], palette[3 * i + 1], palette[3 * i + 2]};
    png_set_PLTE(png, info, colors, entries);
  }
  png_write_info(png, info);
  const int per_byte = 8 / bits;
  for (int y = 0; y < height; ++y) {
    const unsigned char* from = indices + static_cast<std::size_t>(y) * static_cast<std::size_t>(width);
    for (int x = 0; x < width; x += per_byte) {
      unsigned byte = 0;
      for (int k = 0; k < per_byte; ++k) byte = byte << bits | (x + k < width ? from[x + k] : 0u);
      row[x / per_byte] = static_cast<unsigned char>(byte);
    }
    png_write_row(png, row);
  }
  png_write_end(png, info);
}

}  // namespace

std::string encode_indexed_png(const unsigned char* indices, int width, int height, int bits,
                               const unsigned char* palette, int palette_entries, int compression,
                               std::vector<unsigned char>& file) {
  if (palette_entries > 1 << bits)
    return "the palette has " + std::to_string(palette_entries) + " entries, must be at most " +
           std::to_string(1 << bits) + " for " + std::to_string(bits) + " bits";
  Writer writer{file, {}};
  std::vector<unsigned char> row(static_cast<std::size_t>(width));
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &writer, fail, ignore_warning);
  png_infop info = png != nullptr ? png_create_info_struct(png) : nullptr;
  if (info == nullptr) {
    png_destroy_write_struct(&png, nullptr);
    return "libpng: not enough memory";
  }
  png_set_write_fn(png, &writer, append, no_flush);
  write(png, info, indices, width, height, bits, palette, palette_entries, compression, row.data());
  png_destroy_write_struct(&png, &info);
  return writer.error;
}

}  // namespace tessera::program
