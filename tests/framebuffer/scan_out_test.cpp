#include "framebuffer/scan_out.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <random>
#include <utility>
#include <vector>

#include "framebuffer/scan_out_reference.h"
#include "framebuffer/tile_grid.h"

namespace tessera::detail::scan_out_test {
namespace {

struct TileMemory {
  alignas(kTileAlignment) std::uint32_t pixels[kMaxTileSize * kMaxTileSize];
};

constexpr std::uint8_t kUntouched = 0xa5;

/// RGB and index layouts of every depth; index layouts with a full, a partial and an empty palette.
struct Source {
  ColorLayout layout;
  Palette palette;
};
std::vector<Source> sources() {
  std::vector<Source> all;
  for (int bits = 1; bits <= 24; ++bits) {
    all.push_back({rgb_layout(bits), {}});
    all.push_back({index_layout(bits), default_palette_of(bits)});
    all.push_back({index_layout(bits), {.bits = bits, .entries = {{1, 2, 3}}}});
    all.push_back({index_layout(bits), {.bits = bits, .entries = {}}});
  }
  return all;
}

std::uint32_t pixel_at(const std::uint8_t* bytes) {
  std::uint32_t pixel;
  std::memcpy(&pixel, bytes, sizeof pixel);
  return pixel;
}

TEST(ScanOut, RowMatchesReferenceForEveryLevelOfEveryLayout) {
  for (InstructionSet isa : available_isas())
    for (PixelOrder order : {PixelOrder::rgba8, PixelOrder::bgra8})
      for (const Source& source : sources()) {
        const ScanOut scan_out(source.layout, &source.palette, order, isa);
        // Up to 12 bits: all packed pixels. Beyond: every level of each component. Random ones in both cases.
        std::vector<std::uint32_t> packed_pixels;
        if (source.layout.bits <= 12) {
          for (std::uint32_t w = 0; w <= source.layout.value_mask(); ++w) packed_pixels.push_back(w);
        } else {
          for (std::uint32_t v = 0; v < 256; ++v)
            packed_pixels.insert(packed_pixels.end(),
                                 {v, v << source.layout.g_shift(), v << source.layout.r_shift(), ~v});
        }
        std::mt19937 random(3);
        for (int i = 0; i < 501; ++i)
          packed_pixels.push_back(static_cast<std::uint32_t>(random()));  // including bits beyond the layout
        std::vector<std::uint8_t> row(packed_pixels.size() * 4 + 64, kUntouched);
        scan_out.row(packed_pixels.data(), static_cast<int>(packed_pixels.size()), row.data());
        for (std::size_t i = 0; i < packed_pixels.size(); ++i)
          ASSERT_EQ(pixel_at(&row[4 * i]),
                    scan_out_pixel_reference(source.layout, &source.palette, order, packed_pixels[i]))
              << static_cast<int>(isa) << " bits " << source.layout.bits << " index " << source.layout.index
              << " packed_pixel " << packed_pixels[i];
        for (std::size_t i = packed_pixels.size() * 4; i < row.size(); ++i) ASSERT_EQ(row[i], kUntouched);
      }
}

TEST(ScanOut, WritesBytesInTheRequestedOrder) {
  const std::uint32_t packed_pixel = 0x102030;
  std::uint8_t pixel[4];
  ScanOut(rgb_layout(24), nullptr, PixelOrder::rgba8, InstructionSet::scalar).row(&packed_pixel, 1, pixel);
  EXPECT_TRUE(pixel[0] == 0x10 && pixel[1] == 0x20 && pixel[2] == 0x30 && pixel[3] == 255);
  ScanOut(rgb_layout(24), nullptr, PixelOrder::bgra8, InstructionSet::scalar).row(&packed_pixel, 1, pixel);
  EXPECT_TRUE(pixel[0] == 0x30 && pixel[1] == 0x20 && pixel[2] == 0x10 && pixel[3] == 255);
}

TEST(ScanOut, TileMatchesReferenceAndWritesNothingElse) {
  std::mt19937 random(4);
  TileMemory tile;
  for (std::uint32_t& packed_pixel : tile.pixels) packed_pixel = static_cast<std::uint32_t>(random());
  const Source some[] = {{rgb_layout(24), {}},
                         {rgb_layout(16), {}},
                         {rgb_layout(2), {}},
                         {index_layout(8), default_palette_of(8)}};
  for (InstructionSet isa : available_isas())
    for (const Source& source : some)
      for (int tile_size : {32, 64, 128})
        for (int width : {0, 1, 3, 4, 7, 8, 15, 16, 17, 29, 32, 63, 64, 100, 128})
          for (int missing : {0, 5, 6, 7, tile_size - 3}) {
            if (width > tile_size) continue;
            const bool upwards = missing % 2 == 0;
            const int height = tile_size - missing;
            const std::size_t misalignment = static_cast<std::size_t>(width % 4);
            const std::ptrdiff_t stride = 4 * width + 12;
            std::vector<std::uint8_t> image(static_cast<std::size_t>(stride * height) + misalignment,
                                            kUntouched);
            const PixelOrder order = upwards ? PixelOrder::bgra8 : PixelOrder::rgba8;
            const ScanOut scan_out(source.layout, &source.palette, order, isa);
            std::uint8_t* first = image.data() + misalignment + (upwards ? (height - 1) * stride : 0);
            scan_out.tile(tile.pixels, tile_size, width, height, first, upwards ? -stride : stride);
            for (int y = 0; y < height; ++y) {
              const std::uint8_t* row = first + (upwards ? -y : y) * stride;
              for (int x = 0; x < width; ++x)
                ASSERT_EQ(pixel_at(row + 4 * x),
                          scan_out_pixel_reference(source.layout, &source.palette, order,
                                                   tile.pixels[tile_index(x, y, tile_size)]))
                    << static_cast<int>(isa) << " " << tile_size << " " << x << "," << y;
              for (int i = 4 * width; i < stride; ++i) ASSERT_EQ(row[i], kUntouched);
            }
          }
}

TEST(ScanOut, MoveKeepsThePalette) {
  const Palette palette = default_palette_of(4);
  ScanOut first(index_layout(4), &palette, PixelOrder::rgba8, InstructionSet::scalar);
  const ScanOut second = std::move(first);
  const std::uint32_t packed_pixel = 6;
  std::uint8_t pixel[4];
  second.row(&packed_pixel, 1, pixel);
  EXPECT_TRUE(pixel[0] == 170 && pixel[1] == 85 && pixel[2] == 0 && pixel[3] == 255);
}

}  // namespace
}  // namespace tessera::detail::scan_out_test
