// Non-interlaced PNG files (W3C Portable Network Graphics, second edition). Gamma and colour profiles are
// ignored: texels have no transfer curve.
#include <algorithm>
#include <array>
#include <cstdlib>
#include <span>
#include <stdexcept>

#include "image_file.h"
#include "inflate.h"

namespace tessera::reference {
namespace {

using Bytes = std::vector<std::uint8_t>;

unsigned big_endian(std::span<const std::uint8_t> bytes, std::size_t count) {
  unsigned value = 0;
  for (std::size_t i = 0; i < count; ++i) value = value * 256 + bytes[i];
  return value;
}

struct Header {
  int width = 0;
  int height = 0;
  int bit_depth = 0;
  bool has_palette = false;
  bool has_color = false;
  bool has_alpha = false;

  /// Per pixel.
  int samples() const {
    if (has_palette) return 1;
    const int colors = has_color ? 3 : 1;
    return has_alpha ? colors + 1 : colors;
  }
  std::size_t row_bytes() const {
    return (static_cast<std::size_t>(width) * static_cast<std::size_t>(samples() * bit_depth) + 7) / 8;
  }
  std::size_t pixel_bytes() const { return static_cast<std::size_t>((samples() * bit_depth + 7) / 8); }
};

struct Chunks {
  Header header;
  Bytes palette;
  Bytes transparent;
  Bytes data;
};

Header read_header(std::span<const std::uint8_t> chunk) {
  constexpr unsigned kMaxSide = 16384;
  if (chunk.size() != 13) throw std::runtime_error("a PNG file without a header");
  const unsigned width = big_endian(chunk, 4);
  const unsigned height = big_endian(chunk.subspan(4), 4);
  const unsigned type = chunk[9];
  if (width < 1 || width > kMaxSide || height < 1 || height > kMaxSide)
    throw std::runtime_error("a size that is not 1..16384");
  if (type > 6 || type == 1 || type == 5) throw std::runtime_error("a PNG file of an unknown type");
  const int depth = chunk[8];
  constexpr int kDepths[] = {1, 2, 4, 8, 16};
  if (std::ranges::find(kDepths, depth) == std::end(kDepths))
    throw std::runtime_error("a PNG file of an unknown depth");
  if (chunk[12] != 0) throw std::runtime_error("an interlaced PNG file");
  return {static_cast<int>(width), static_cast<int>(height), depth,
          (type & 1) != 0,         (type & 2) != 0,          (type & 4) != 0};
}

Chunks read_chunks(const Bytes& bytes) {
  constexpr std::size_t kSignature = 8;
  constexpr std::size_t kAround = 12;  // length, type and checksum of a chunk
  Chunks chunks;
  for (std::size_t at = kSignature;;) {
    if (at + kAround > bytes.size()) throw std::runtime_error("a file that ends early");
    const std::span<const std::uint8_t> rest = std::span(bytes).subspan(at);
    const std::size_t length = big_endian(rest, 4);
    if (length > rest.size() - kAround) throw std::runtime_error("a file that ends early");
    const std::string name(rest.begin() + 4, rest.begin() + 8);
    const std::span<const std::uint8_t> data = rest.subspan(8, length);
    if (name == "IHDR") chunks.header = read_header(data);
    if (name == "PLTE") chunks.palette.assign(data.begin(), data.end());
    if (name == "tRNS") chunks.transparent.assign(data.begin(), data.end());
    if (name == "IDAT") chunks.data.insert(chunks.data.end(), data.begin(), data.end());
    if (name == "IEND") break;
    at += length + kAround;
  }
  if (chunks.header.width == 0) throw std::runtime_error("a PNG file without a header");
  return chunks;
}

int paeth(int left, int up, int corner) {
  const int p = left + up - corner;
  const int to_left = std::abs(p - left);
  const int to_up = std::abs(p - up);
  const int to_corner = std::abs(p - corner);
  if (to_left <= to_up && to_left <= to_corner) return left;
  return to_up <= to_corner ? up : corner;
}

/// Undoes the row filters.
Bytes unfiltered(const Bytes& filtered, const Header& header) {
  const std::size_t row = header.row_bytes();
  const std::size_t pixel = header.pixel_bytes();
  const std::size_t height = static_cast<std::size_t>(header.height);
  if (filtered.size() < height * (row + 1)) throw std::runtime_error("a PNG file with too little data");
  Bytes out(height * row);
  for (std::size_t y = 0; y < height; ++y)
    for (std::size_t i = 0; i < row; ++i) {
      const auto before = [&](std::size_t back, std::size_t rows_up) {
        return i < back || y < rows_up ? 0 : int{out[(y - rows_up) * row + i - back]};
      };
      const int left = before(pixel, 0);
      const int up = before(0, 1);
      const int corner = before(pixel, 1);
      int predicted = 0;
      switch (filtered[y * (row + 1)]) {
        case 0: break;
        case 1: predicted = left; break;
        case 2: predicted = up; break;
        case 3: predicted = (left + up) / 2; break;
        case 4: predicted = paeth(left, up, corner); break;
        default: throw std::runtime_error("a PNG file with an unknown filter");
      }
      out[y * row + i] = static_cast<std::uint8_t>(filtered[y * (row + 1) + 1 + i] + predicted);
    }
  return out;
}

/// Unconverted samples of one pixel.
std::array<unsigned, 4> samples_at(const Bytes& rows, const Header& header, std::size_t x, std::size_t y) {
  std::array<unsigned, 4> samples{};
  const auto depth = static_cast<std::size_t>(header.bit_depth);
  const auto count = static_cast<std::size_t>(header.samples());
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t bit = (x * count + i) * depth;
    const std::span<const std::uint8_t> at = std::span(rows).subspan(y * header.row_bytes() + bit / 8);
    samples[i] = depth == 16 ? big_endian(at, 2) : at[0] >> (8 - depth - bit % 8) & ((1u << depth) - 1);
  }
  return samples;
}

void append_entry(const Chunks& chunks, std::size_t entry, Image& image) {
  if (3 * entry + 3 > chunks.palette.size())
    throw std::runtime_error("a PNG file with an index beyond its palette");
  for (std::size_t i = 0; i < 3; ++i) image.levels.push_back(chunks.palette[3 * entry + i]);
  if (image.channels == 4)
    image.levels.push_back(entry < chunks.transparent.size() ? chunks.transparent[entry] : 255);
}

}  // namespace

Image read_png(const Bytes& bytes) {
  const Chunks chunks = read_chunks(bytes);
  const Header& header = chunks.header;
  const auto count = static_cast<std::size_t>(header.samples());
  // The image declares one transparent colour.
  const bool has_key = !header.has_palette && chunks.transparent.size() >= 2 * count;
  const Bytes rows = unfiltered(inflate(chunks.data), header);

  Image image;
  image.width = header.width;
  image.height = header.height;
  if (header.has_palette) image.channels = chunks.transparent.empty() ? 3 : 4;
  else image.channels = has_key ? header.samples() + 1 : header.samples();
  const unsigned largest = (1u << header.bit_depth) - 1;
  for (std::size_t y = 0; y < static_cast<std::size_t>(header.height); ++y)
    for (std::size_t x = 0; x < static_cast<std::size_t>(header.width); ++x) {
      const std::array<unsigned, 4> samples = samples_at(rows, header, x, y);
      if (header.has_palette) {
        append_entry(chunks, samples[0], image);
        continue;
      }
      bool is_key = has_key;
      for (std::size_t i = 0; i < count; ++i) {
        image.levels.push_back(level_in_8_bits(samples[i], largest));
        if (has_key && samples[i] != big_endian(std::span(chunks.transparent).subspan(2 * i), 2))
          is_key = false;
      }
      if (has_key) image.levels.push_back(is_key ? 0 : 255);
    }
  return image;
}

}  // namespace tessera::reference
