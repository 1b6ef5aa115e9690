#include "framebuffer/bit_transpose.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <random>
#include <string>
#include <vector>

#include "framebuffer/bit_transpose_reference.h"
#include "framebuffer/tile_grid.h"

namespace tessera::detail {
namespace {

struct TileMemory {
  alignas(kTileAlignment) std::uint32_t words[kMaxTileSize * kMaxTileSize];
};

struct Case {
  int width, height, planes, tile_size;
  std::uint32_t mask, flip;
};

std::vector<Case> cases() {
  std::vector<Case> all;
  std::mt19937 random(7);
  for (int planes = 1; planes <= kMaxPlanes; ++planes)
    for (int tile_size : {32, 64, 128}) {
      const std::uint32_t mask = planes % 3 == 0 ? 0xffffffffu : static_cast<std::uint32_t>(random());
      const std::uint32_t flip = planes % 4 == 0 ? static_cast<std::uint32_t>(random()) : 0;
      all.push_back({static_cast<int>(1 + random() % 300), static_cast<int>(1 + random() % 140), planes,
                     tile_size, mask, flip});
      all.push_back({tile_size * 2, tile_size, planes, tile_size, 0xffffffffu, 0});
    }
  for (int width : {1, 7, 8, 9, 31, 32, 33, 63, 64, 65, 127, 129, 512, 513, 1017})
    for (int tile_size : {32, 64, 128}) all.push_back({width, 35, 24, tile_size, 0xffffffffu, 0});
  for (std::uint32_t mask : {0u, 1u, 0x800000u, 0xff0000u, 0xff00u, 0xffu, 0xf0f0f0u, 0xffffu})
    all.push_back({150, 70, 24, 64, mask, 0});
  return all;
}
std::string text(const Case& c) {
  return std::to_string(c.width) + "x" + std::to_string(c.height) + " planes " + std::to_string(c.planes) +
         " tile " + std::to_string(c.tile_size) + " mask " + std::to_string(c.mask) + " flip " +
         std::to_string(c.flip);
}

void randomize(TileMemory& tile, std::mt19937& random) {
  for (std::uint32_t& word : tile.words) word = static_cast<std::uint32_t>(random());
}
/// A stack of random words.
BitplaneStack random_stack(const Case& c, std::mt19937& random) {
  BitplaneStack stack(c.width, c.height, c.planes);
  stack.allocate(0);
  for (int y = 0; y < c.height; ++y)
    for (int x = 0; x < c.width; ++x) stack.set_pixel(x, y, static_cast<std::uint32_t>(random()));
  return stack;
}
BitplaneStack copy_of(const BitplaneStack& stack) {
  BitplaneStack copy(stack.width_px(), stack.height_px(), stack.plane_count());
  copy.allocate(0);
  for (int k = 0; k < stack.plane_count(); ++k)
    std::memcpy(copy.plane(k), stack.plane(k),
                static_cast<std::size_t>(stack.stride_bytes() * stack.height_px()));
  return copy;
}
/// Every byte of the rows, pad included.
bool same_bits(const BitplaneStack& a, const BitplaneStack& b) {
  for (int k = 0; k < a.plane_count(); ++k)
    if (std::memcmp(a.plane(k), b.plane(k), static_cast<std::size_t>(a.stride_bytes() * a.height_px())) != 0)
      return false;
  return true;
}

/// All ways to store that this machine can run.
std::vector<StorePlanesFn*> ways() {
  std::vector<StorePlanesFn*> all;
  for (InstructionSet isa : available_isas())
    for (StorePlanesFn* way : {store_planes_for(isa), store_planes_per_tile(isa)})
      if (std::find(all.begin(), all.end(), way) == all.end()) all.push_back(way);
  return all;
}
void store_tile(StorePlanesFn* store, const std::uint32_t* words, const TilePlace& place,
                BitplaneStack& planes, std::uint32_t mask = ~0u) {
  store({&words, 1}, place, planes, mask);
}

enum class Together { one_tile, a_line, any_number };
/// How many tiles from x on go into the planes together.
int run_of(Together together, const Case& c, int x, std::mt19937& random) {
  const int to_line_end = kLinePixels / c.tile_size - x % kLinePixels / c.tile_size,
            to_edge = (c.width - x + c.tile_size - 1) / c.tile_size;
  const int most = std::min(to_line_end, to_edge);
  return together == Together::one_tile ? 1
         : together == Together::a_line ? most
                                        : static_cast<int>(1 + random() % static_cast<unsigned>(most));
}

TEST(BitTranspose, StoreMatchesReferenceBitForBitHoweverManyTilesGoTogether) {
  std::vector<TileMemory> tiles(kLinePixels / kMinTileSize);
  const std::vector<StorePlanesFn*> all = ways();
  for (std::size_t w = 0; w < all.size(); ++w)
    for (const Case& c : cases())
      for (const Together together : {Together::one_tile, Together::a_line, Together::any_number}) {
        std::mt19937 random(11);
        BitplaneStack stored = random_stack(c, random);
        BitplaneStack expected = copy_of(stored);
        for (int y = 0; y < c.height; y += c.tile_size)
          for (int x = 0, run; x < c.width; x += run * c.tile_size) {
            run = run_of(together, c, x, random);
            std::vector<const std::uint32_t*> words;
            for (int t = 0; t < run; ++t) {
              TileMemory& tile = tiles[static_cast<std::size_t>(t)];
              randomize(tile, random);
              words.push_back(tile.words);
              store_planes_reference(
                  tile.words,
                  {.x0_px = x + t * c.tile_size, .y0_px = y, .tile_size = c.tile_size, .flip = c.flip},
                  expected, c.mask);
            }
            all[w](words, {.x0_px = x, .y0_px = y, .tile_size = c.tile_size, .flip = c.flip}, stored, c.mask);
            // At once: what it did to tiles on its right would be stored over.
            ASSERT_TRUE(same_bits(stored, expected))
                << "way " << w << ", together " << static_cast<int>(together) << ", from " << x << " " << y
                << ", " << text(c);
          }
      }
}

TEST(BitTranspose, LoadMatchesReferenceBitForBitOnEveryIsa) {
  for (InstructionSet isa : available_isas())
    for (const Case& c : cases()) {
      std::mt19937 random(13);
      const BitplaneStack stack = random_stack(c, random);
      TileMemory loaded, expected;
      for (int y = 0; y < c.height; y += c.tile_size)
        for (int x = 0; x < c.width; x += c.tile_size) {
          randomize(loaded, random);  // rows below the picture stay as they were
          expected = loaded;
          const TilePlace place{.x0_px = x, .y0_px = y, .tile_size = c.tile_size, .flip = c.flip};
          load_planes_for(isa)(loaded.words, place, stack);
          load_planes_reference(expected.words, place, stack);
          ASSERT_EQ(std::memcmp(loaded.words, expected.words, sizeof loaded.words), 0)
              << static_cast<int>(isa) << " " << text(c);
        }
    }
}

TEST(BitTranspose, PadBitsStayZeroWhateverTheTileHolds) {
  for (StorePlanesFn* store : ways())
    for (int width : {1, 5, 31, 33, 70, 130})
      for (int tile_size : {32, 64, 128}) {
        BitplaneStack stack(width, 3, 20);
        stack.allocate(0);
        TileMemory tile;
        std::memset(tile.words, 0xff, sizeof tile.words);
        for (int x = 0; x < width; x += tile_size)
          store_tile(store, tile.words, {.x0_px = x, .tile_size = tile_size}, stack);
        for (int k = 0; k < 20; ++k)
          for (int y = 0; y < 3; ++y) {
            int bits = 0;
            for (std::ptrdiff_t i = 0; i < stack.stride_bytes(); ++i)
              bits += __builtin_popcount(stack.plane(k)[y * stack.stride_bytes() + i]);
            ASSERT_EQ(bits, width) << width << " " << tile_size;
          }
      }
}

TEST(BitTranspose, ATileWritesNothingOfItsNeighbours) {
  for (StorePlanesFn* store : ways())
    for (int tile_size : {32, 64, 128}) {
      BitplaneStack stack(3 * tile_size, 3 * tile_size, 24);
      stack.allocate(0xffffff);
      TileMemory tile;
      std::memset(tile.words, 0, sizeof tile.words);
      store_tile(store, tile.words, {.x0_px = tile_size, .y0_px = tile_size, .tile_size = tile_size}, stack);
      for (int y = 0; y < 3 * tile_size; ++y)
        for (int x = 0; x < 3 * tile_size; ++x)
          ASSERT_EQ(stack.pixel(x, y), x / tile_size == 1 && y / tile_size == 1 ? 0u : 0xffffffu)
              << x << " " << y;
    }
}

TEST(BitTranspose, DepthKeysOf32BitsComeBackThroughTheFlip) {
  for (InstructionSet isa : available_isas()) {
    BitplaneStack stack(64, 64, 32);
    stack.allocate(0);
    TileMemory keys, back;
    for (std::uint32_t i = 0; i < 64 * 64; ++i) keys.words[i] = (i * 0x100401u) ^ 0x80000000u;
    const TilePlace place{.flip = 0x80000000u};
    store_tile(store_planes_for(isa), keys.words, place, stack);
    EXPECT_EQ(stack.pixel(1, 0), 0x100401u);
    load_planes_for(isa)(back.words, place, stack);
    EXPECT_EQ(std::memcmp(keys.words, back.words, 64 * 64 * 4), 0);
  }
}

}  // namespace
}  // namespace tessera::detail
