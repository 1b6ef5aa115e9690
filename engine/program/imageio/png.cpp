#include "engine/program/imageio/png.h"

#include <memory>
#include <new>

#include <libdeflate.h>

#include "engine/program/imageio/png_chunks.h"

namespace tessera::program {
namespace {

enum class Filter : std::uint8_t { none = 0, sub = 1 };

/// Differences help components, but not indices and not pixels that share a byte [PNG, 12.7]. One filter for
/// all rows: choosing one per row by the sum of differences takes longer than the compression, and rows of
/// dithered pictures get larger.
Filter filter_of(const PngFormat& format) {
  return format.color == PngColor::palette || format.bits < 8 ? Filter::none : Filter::sub;
}

// Filt(x) = Orig(x) - Orig(a), with a the byte of the pixel on the left, 0 for the first [PNG, 9.2].
void subtract_left(const std::uint8_t* row, std::size_t count, std::size_t pixel_bytes, std::uint8_t* to) {
  for (std::size_t i = 0; i < pixel_bytes; ++i) to[i] = row[i];
  for (std::size_t i = pixel_bytes; i < count; ++i)
    to[i] = static_cast<std::uint8_t>(row[i] - row[i - pixel_bytes]);
}

struct Bytes {
  explicit Bytes(std::size_t count)
      : data(std::make_unique_for_overwrite<std::uint8_t[]>(count)), size(count) {}
  std::unique_ptr<std::uint8_t[]> data;
  std::size_t size;
};

/// All rows, each after the number of its filter.
Bytes filtered_rows(const PngImage& image) {
  const PngFormat& format = image.format;
  const std::size_t count = row_bytes(format);
  const std::size_t pixel_bytes = static_cast<std::size_t>(channel_count(format.color) * format.bits) / 8;
  const Filter filter = filter_of(format);
  std::vector<std::uint8_t> row(count);
  Bytes filtered((1 + count) * static_cast<std::size_t>(format.height));
  std::uint8_t* to = filtered.data.get();
  for (int y = 0; y < format.height; ++y, to += count) {
    *to++ = static_cast<std::uint8_t>(filter);
    if (filter == Filter::none) {
      image.fill_row(y, to);
    } else {
      image.fill_row(y, row.data());
      subtract_left(row.data(), count, pixel_bytes, to);
    }
  }
  return filtered;
}

struct FreeCompressor {
  void operator()(libdeflate_compressor* compressor) const { libdeflate_free_compressor(compressor); }
};

}  // namespace

std::string compress_pixels(const PngImage& image, int level) {
  const std::unique_ptr<libdeflate_compressor, FreeCompressor> compressor(
      libdeflate_alloc_compressor(level == kDefaultCompression ? kDefaultPngLevel : level));
  if (!compressor) throw std::bad_alloc();
  const Bytes filtered = filtered_rows(image);
  Bytes compressed(libdeflate_zlib_compress_bound(compressor.get(), filtered.size));
  const std::size_t size = libdeflate_zlib_compress(compressor.get(), filtered.data.get(), filtered.size,
                                                    compressed.data.get(), compressed.size);
  return {reinterpret_cast<const char*>(compressed.data.get()), size};
}

std::string encode_png(const PngImage& image, int level) {
  std::string file;
  append_png_header(image.format, file);
  append_palette(image.palette, file);
  append_pixel_data(compress_pixels(image, level), file);
  append_chunk("IEND", "", file);
  return file;
}

}  // namespace tessera::program
