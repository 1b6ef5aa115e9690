// Kernels between the packed pixels of a tile and the planes of a stack: a transposition of bits.
//
// A tile is in tile memory (4x4 blocks, see tile_index() in tile_grid.h), one std::uint32_t per pixel; plane
// k is bit k. Tiles start at multiples of their size, 32, 64 or 128 pixels, so a row of a tile is 4, 8 or 16
// whole bytes of a plane. Twins: bit_transpose_reference.h.
#pragma once

#include <cstdint>
#include <span>

#include "framebuffer/bitplane.h"
#include "framebuffer/instruction_set.h"

namespace tessera::detail {

/// Position of a tile in the picture, and the bits that change between tile and planes.
struct TilePlace {
  /// Top left pixel of the tile, rows counted from the top of the picture. Multiples of tile_size, inside the
  /// picture.
  int x0_px = 0, y0_px = 0;
  int tile_size = 64;  ///< 32, 64 or 128
  /// XORed with every pixel on store and on load: 0x80000000 between keys and levels of 32-bit depth, else 0.
  std::uint32_t flip = 0;
};

/// Stores tiles in planes.
/// - Only pixels inside the picture are stored; pad bits of the planes stay 0.
/// - Plane k is written if bit k of `plane_store_mask` is set; bits beyond the stack's planes are ignored.
/// - Bit-identical to store_planes_reference() on every instruction set. Never fails, never allocates.
/// - Threads: distinct tiles share no byte and may be stored concurrently. One thread per cache line of the
///   planes is faster.
///
/// @param tiles   adjacent tiles from left to right, at least one, tile_size^2 pixels each, kTileAlignment
///                aligned. All lie in one cache line (kLinePixels) of the planes, and each begins inside the
///                picture.
/// @param first   place of the leftmost tile
/// @param planes  allocated
using StorePlanesFn = void(std::span<const std::uint32_t* const> tiles, const TilePlace& first,
                           BitplaneStack& planes, std::uint32_t plane_store_mask) noexcept;

/// Loads a tile from planes.
/// - Bits beyond the stack's planes, and pixels to the right of the picture, become 0 (before the flip).
/// - Rows below the picture keep their content.
using LoadPlanesFn = void(std::uint32_t* tile, const TilePlace& place, const BitplaneStack& planes) noexcept;

/// Fastest store kernel that this machine can run for `isa`.
StorePlanesFn* store_planes_for(InstructionSet isa) noexcept;
/// Number of tiles that store_planes_for() stores best in one call: the tiles of a cache line if the kernel
/// writes whole lines, else 1.
int tiles_per_store(InstructionSet isa, int tile_size) noexcept;
/// Store kernel without the whole-line path. Tests compare both kernels with the reference.
StorePlanesFn* store_planes_per_tile(InstructionSet isa) noexcept;
LoadPlanesFn* load_planes_for(InstructionSet isa) noexcept;

}  // namespace tessera::detail
