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

namespace tessera::detail::bit_transpose_test {
namespace {

struct TileMemory {
  alignas(kTileAlignment) std::uint32_t pixels[kMaxTileSize * kMaxTileSize];
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
  for (std::uint32_t& pixel : tile.pixels) pixel = static_cast<std::uint32_t>(random());
}
/// A stack of random pixels.
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
/// Compares every byte of the rows, padding included.
bool same_bits(const BitplaneStack& a, const BitplaneStack& b) {
  for (int k = 0; k < a.plane_count(); ++k)
    if (std::memcmp(a.plane(k), b.plane(k), static_cast<std::size_t>(a.stride_bytes() * a.height_px())) != 0)
      return false;
  return true;
}

/// All store kernels that this machine can run.
std::vector<StorePlanesFn*> store_kernels() {
  std::vector<StorePlanesFn*> all;
  for (InstructionSet isa : available_isas())
    for (StorePlanesFn* kernel : {store_planes_for(isa), store_planes_per_tile(isa)})
      if (std::find(all.begin(), all.end(), kernel) == all.end()) all.push_back(kernel);
  return all;
}
void store_tile(StorePlanesFn* store, const std::uint32_t* pixels, const TilePlace& place,
                BitplaneStack& planes, std::uint32_t mask = ~0u) {
  store({&pixels, 1}, place, planes, mask);
}

enum class TilesPerCall { one, line, random };
/// Number of tiles from x on that are stored in one call.
int run_length(TilesPerCall tiles_per_call, const Case& c, int x, std::mt19937& random) {
  const int to_line_end = kLinePixels / c.tile_size - x % kLinePixels / c.tile_size;
  const int to_edge = (c.width - x + c.tile_size - 1) / c.tile_size;
  const int max = std::min(to_line_end, to_edge);
  if (tiles_per_call == TilesPerCall::one) return 1;
  if (tiles_per_call == TilesPerCall::line) return max;
  return static_cast<int>(1 + random() % static_cast<unsigned>(max));
}

TEST(BitTranspose, StoreMatchesReferenceForAnyNumberOfTilesPerCall) {
  std::vector<TileMemory> tiles(kLinePixels / kMinTileSize);
  const std::vector<StorePlanesFn*> kernels = store_kernels();
  for (std::size_t kernel = 0; kernel < kernels.size(); ++kernel)
    for (const Case& c : cases())
      for (const TilesPerCall per_call : {TilesPerCall::one, TilesPerCall::line, TilesPerCall::random}) {
        std::mt19937 random(11);
        BitplaneStack stored = random_stack(c, random);
        BitplaneStack expected = copy_of(stored);
        for (int y = 0; y < c.height; y += c.tile_size)
          for (int x = 0, run; x < c.width; x += run * c.tile_size) {
            run = run_length(per_call, c, x, random);
            std::vector<const std::uint32_t*> pixels;
            for (int t = 0; t < run; ++t) {
              TileMemory& tile = tiles[static_cast<std::size_t>(t)];
              randomize(tile, random);
              pixels.push_back(tile.pixels);
              store_planes_reference(
                  tile.pixels,
                  {.x0_px = x + t * c.tile_size, .y0_px = y, .tile_size = c.tile_size, .flip = c.flip},
                  expected, c.mask);
            }
            kernels[kernel](pixels, {.x0_px = x, .y0_px = y, .tile_size = c.tile_size, .flip = c.flip},
                            stored, c.mask);
            // Compare after every call: later calls would overwrite damage done to tiles on the right.
            ASSERT_TRUE(same_bits(stored, expected))
                << "kernel " << kernel << ", tiles per call " << static_cast<int>(per_call) << ", from " << x
                << " " << y << ", " << text(c);
          }
      }
}

TEST(BitTranspose, LoadMatchesReferenceOnEveryInstructionSet) {
  for (InstructionSet isa : available_isas())
    for (const Case& c : cases()) {
      std::mt19937 random(13);
      const BitplaneStack stack = random_stack(c, random);
      TileMemory loaded, expected;
      for (int y = 0; y < c.height; y += c.tile_size)
        for (int x = 0; x < c.width; x += c.tile_size) {
          randomize(loaded, random);  // rows below the picture must keep this content
          expected = loaded;
          const TilePlace place{.x0_px = x, .y0_px = y, .tile_size = c.tile_size, .flip = c.flip};
          load_planes_for(isa)(loaded.pixels, place, stack);
          load_planes_reference(expected.pixels, place, stack);
          ASSERT_EQ(std::memcmp(loaded.pixels, expected.pixels, sizeof loaded.pixels), 0)
              << static_cast<int>(isa) << " " << text(c);
        }
    }
}

TEST(BitTranspose, PadBitsStayZeroForAnyTileContent) {
  for (StorePlanesFn* store : store_kernels())
    for (int width : {1, 5, 31, 33, 70, 130})
      for (int tile_size : {32, 64, 128}) {
        BitplaneStack stack(width, 3, 20);
        stack.allocate(0);
        TileMemory tile;
        std::memset(tile.pixels, 0xff, sizeof tile.pixels);
        for (int x = 0; x < width; x += tile_size)
          store_tile(store, tile.pixels, {.x0_px = x, .tile_size = tile_size}, stack);
        for (int k = 0; k < 20; ++k)
          for (int y = 0; y < 3; ++y) {
            int bits = 0;
            for (std::ptrdiff_t i = 0; i < stack.stride_bytes(); ++i)
              bits += __builtin_popcount(stack.plane(k)[y * stack.stride_bytes() + i]);
            ASSERT_EQ(bits, width) << width << " " << tile_size;
          }
      }
}

TEST(BitTranspose, StoreLeavesNeighbouringTilesUntouched) {
  for (StorePlanesFn* store : store_kernels())
    for (int tile_size : {32, 64, 128}) {
      BitplaneStack stack(3 * tile_size, 3 * tile_size, 24);
      stack.allocate(0xffffff);
      TileMemory tile;
      std::memset(tile.pixels, 0, sizeof tile.pixels);
      store_tile(store, tile.pixels, {.x0_px = tile_size, .y0_px = tile_size, .tile_size = tile_size}, stack);
      for (int y = 0; y < 3 * tile_size; ++y)
        for (int x = 0; x < 3 * tile_size; ++x)
          ASSERT_EQ(stack.pixel(x, y), x / tile_size == 1 && y / tile_size == 1 ? 0u : 0xffffffu)
              << x << " " << y;
    }
}

TEST(BitTranspose, FlippedDepthKeysOf32BitsRoundTrip) {
  for (InstructionSet isa : available_isas()) {
    BitplaneStack stack(64, 64, 32);
    stack.allocate(0);
    TileMemory keys, back;
    for (std::uint32_t i = 0; i < 64 * 64; ++i) keys.pixels[i] = (i * 0x100401u) ^ 0x80000000u;
    const TilePlace place{.flip = 0x80000000u};
    store_tile(store_planes_for(isa), keys.pixels, place, stack);
    EXPECT_EQ(stack.pixel(1, 0), 0x100401u);
    load_planes_for(isa)(back.pixels, place, stack);
    EXPECT_EQ(std::memcmp(keys.pixels, back.pixels, 64 * 64 * 4), 0);
  }
}

}  // namespace
}  // namespace tessera::detail::bit_transpose_test
