// PNG files, decoded by libpng.
#include "engine/program/imageio/png.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "engine/program/imageio/png_chunks.h"
#include "tests/engine/program/imageio/png_chunk_walk.h"
#include "tests/engine/program/imageio/png_reader.h"

namespace tessera::program::png_test {
namespace {

using Rows = std::vector<std::vector<std::uint8_t>>;

/// All pairs of colour type and bits that PNG allows [PNG, table 12].
std::vector<PngFormat> all_formats() {
  std::vector<PngFormat> formats;
  for (const int bits : {1, 2, 4, 8, 16}) formats.push_back({.bits = bits, .color = PngColor::gray});
  for (const int bits : {1, 2, 4, 8}) formats.push_back({.bits = bits, .color = PngColor::palette});
  for (const PngColor color : {PngColor::gray_alpha, PngColor::rgb, PngColor::rgba})
    for (const int bits : {8, 16}) formats.push_back({.bits = bits, .color = color});
  return formats;
}

/// Rows of noise, of a constant and of a gradient; bits to the right of the picture are 0.
Rows pattern(const PngFormat& format) {
  std::mt19937 random(7);
  const int row_bits = format.width * format.bits * channel_count(format.color);
  Rows rows(static_cast<std::size_t>(format.height),
            std::vector<std::uint8_t>((static_cast<std::size_t>(row_bits) + 7) / 8));
  for (std::size_t y = 0; y < rows.size(); ++y) {
    for (std::size_t i = 0; i < rows[y].size(); ++i)
      rows[y][i] = static_cast<std::uint8_t>(y % 3 == 0 ? random() : y % 3 == 1 ? 0x5a : 3 * i + y);
    if (row_bits % 8 != 0) rows[y].back() &= static_cast<std::uint8_t>(0xff00u >> row_bits % 8);
  }
  return rows;
}

PngImage image_of(const PngFormat& format, const Rows& rows) {
  PngImage image{.format = format, .palette = {}, .fill_row = [&rows](int y, std::uint8_t* row) {
                   std::copy(rows[static_cast<std::size_t>(y)].begin(),
                             rows[static_cast<std::size_t>(y)].end(), row);
                 }};
  if (format.color == PngColor::palette)
    for (int i = 0; i < 3 << format.bits; ++i) image.palette.push_back(static_cast<std::uint8_t>(255 - i));
  return image;
}

std::vector<std::uint8_t> noise(std::size_t count, unsigned limit = 256) {
  std::mt19937 random(3);
  std::vector<std::uint8_t> bytes(count);
  for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random() % limit);
  return bytes;
}

TEST(PngFile, LibpngReadsEveryFormat) {
  for (PngFormat format : all_formats())
    for (const int width : {1, 2, 3, 7, 8, 9, 33, 200})
      for (const int level : {kDefaultCompression, 0, 1, 9}) {
        format.width = width;
        format.height = 5;
        const Rows rows = pattern(format);
        const PngImage image = image_of(format, rows);
        const DecodedPng decoded = read_by_libpng(encode_png(image, level));
        const std::string what = std::to_string(static_cast<int>(format.color)) + ", " +
                                 std::to_string(format.bits) + " bits, width " + std::to_string(width) +
                                 ", level " + std::to_string(level);
        EXPECT_EQ(decoded.width, width) << what;
        EXPECT_EQ(decoded.height, 5) << what;
        EXPECT_EQ(decoded.bits, format.bits) << what;
        EXPECT_EQ(decoded.color, static_cast<int>(format.color)) << what;
        EXPECT_EQ(decoded.palette, image.palette) << what;
        EXPECT_EQ(decoded.rows, rows) << what;
      }
}

TEST(PngFile, ChunksFollowTheSpecification) {
  const PngFormat format{.width = 9, .height = 4, .bits = 2, .color = PngColor::palette};
  const Rows rows = pattern(format);
  const auto chunks = png_chunks(encode_png(image_of(format, rows), 3));
  EXPECT_EQ(types_of(chunks), "IHDR PLTE IDAT IEND");
  EXPECT_EQ(chunks[0].data, std::string("\0\0\0\x09\0\0\0\x04\x02\x03\0\0\0", 13));
}

TEST(PngFile, LargeDataIsDividedIntoChunks) {
  Picture picture(1000, 800);
  picture.rgba = noise(picture.rgba.size());
  const std::string file = encode_png(as_png(picture, 3), kDefaultCompression);
  const auto chunks = png_chunks(file);
  EXPECT_EQ(types_of(chunks), "IHDR IDAT IDAT IDAT IEND");
  for (const PngChunk& chunk : chunks) EXPECT_LE(chunk.data.size(), kMaxPngDataBytes);
  const DecodedPng decoded = read_by_libpng(file);
  for (std::size_t i = 0; i < std::size_t{1000} * 800; ++i)
    for (std::size_t c = 0; c < 3; ++c)
      ASSERT_EQ(decoded.rows[i / 1000][3 * (i % 1000) + c], picture.rgba[4 * i + c]) << i;
}

TEST(PngFile, PicturesKeepTheirComponents) {
  for (const int width : {1, 2, 17})
    for (const int channels : {3, 4}) {
      Picture picture(width, 3);
      picture.rgba = noise(picture.rgba.size());
      const DecodedPng decoded = read_by_libpng(encode_png(as_png(picture, channels), 6));
      EXPECT_EQ(decoded.color, channels == 3 ? 2 : 6);
      const auto pixel_bytes = static_cast<std::size_t>(channels);
      const auto columns = static_cast<std::size_t>(width);
      for (std::size_t i = 0; i < 3 * columns; ++i)
        for (std::size_t c = 0; c < pixel_bytes; ++c)
          EXPECT_EQ(decoded.rows[i / columns][pixel_bytes * (i % columns) + c], picture.rgba[4 * i + c]);
    }
}

TEST(PngFile, IndicesKeepTheirBitsAndPalettes) {
  for (const int bits : {1, 2, 4, 8})
    for (const bool has_palette : {false, true}) {
      IndexedPicture picture{.width = 13, .height = 6, .bits = bits};
      picture.indices = noise(std::size_t{13} * 6, 1u << bits);
      if (has_palette) picture.palette = noise(std::size_t{3} << bits);
      const DecodedPng decoded = read_by_libpng(encode_png(as_png(picture), kDefaultCompression));
      EXPECT_EQ(decoded.bits, bits);
      EXPECT_EQ(decoded.color, has_palette ? 3 : 0);
      EXPECT_EQ(decoded.palette, picture.palette);
      for (int i = 0; i < 13 * 6; ++i) {
        const auto& row = decoded.rows[static_cast<std::size_t>(i / 13)];
        const int bit = i % 13 * bits;
        const int index = row[static_cast<std::size_t>(bit / 8)] >> (8 - bits - bit % 8) & ((1 << bits) - 1);
        ASSERT_EQ(index, picture.indices[static_cast<std::size_t>(i)]) << bits << " bits, pixel " << i;
      }
    }
}

TEST(PngFile, RefusesPalettesThatAreTooLong) {
  IndexedPicture picture{.width = 1, .height = 1, .bits = 2};
  picture.indices = {0};
  picture.palette.resize(15);
  try {
    as_png(picture);
    ADD_FAILURE() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(std::string(error.what()), "the palette has 5 entries, must be at most 4 for 2 bits");
  }
}

TEST(PngFile, HigherLevelsAreSmaller) {
  Picture picture(300, 200);
  for (std::size_t i = 0; i < picture.rgba.size(); ++i)
    picture.rgba[i] = static_cast<std::uint8_t>(i / 4 % 300 * (i / 1200) / 97 + 40 * (i % 4));
  const auto bytes = [&](int level) { return encode_png(as_png(picture, 3), level).size(); };
  EXPECT_GT(bytes(0), std::size_t{300} * 200 * 3);
  EXPECT_GT(bytes(1), bytes(6));
  EXPECT_GE(bytes(6), bytes(9));
  EXPECT_EQ(bytes(kDefaultCompression), bytes(kDefaultPngLevel));
}

}  // namespace
}  // namespace tessera::program::png_test
