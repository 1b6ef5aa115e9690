// Kernels between the words of a tile and the planes of a stack: a transposition of bits.
//
// A tile is in tile memory (4x4 blocks, see tile_index() in tile_grid.h), one std::uint32_t for each pixel;
// plane k is bit k. Tiles start at multiples of their size, 32, 64 or 128 pixels, so that a row of a tile is
// 4, 8 or 16 whole bytes of a plane. Twins: bit_transpose_reference.h.
#pragma once

#include <cstdint>
#include <span>

#include "framebuffer/bitplane.h"
#include "framebuffer/instruction_set.h"

namespace tessera::detail {

/// Where a tile lies in the picture, and what changes on the way.
struct TilePlace {
  int x0_px = 0,
      y0_px =
          0;  ///< its top left pixel, from the top of the picture; multiples of tile_size, inside the picture
  int tile_size = 64;  ///< 32, 64 or 128
  std::uint32_t flip =
      0;  ///< XORed to the word both ways: 0x80000000 between depth keys and levels of 32 bits, else 0
};

/// Tiles -> planes: of those pixels that lie in the picture. Plane k is written if bit k of
/// `plane_store_mask` is set; bits beyond the stack's planes are ignored. What of a tile sticks out of the
/// picture is not stored: pad bits stay 0, whatever the tile holds there.
///
/// @param tiles   neighbours from left to right, one at least; all lie in one line (kLinePixels) of the
/// planes, and each begins
///                inside the picture. tile_size^2 words each, kTileAlignment aligned.
/// @param first   the place of the leftmost.
/// @param planes  allocated. Tiles whose pixels share no byte, that is distinct tiles, may be stored by
/// distinct threads; it
///                is faster if one thread owns each line.
/// Bit-identical to store_planes_reference() on every instruction set. Never fails, never allocates.
using StorePlanesFn = void(std::span<const std::uint32_t* const> tiles, const TilePlace& first,
                           BitplaneStack& planes, std::uint32_t plane_store_mask) noexcept;

/// Planes -> tile: every word of the rows that lie in the picture. Bits beyond the stack's planes are 0
/// (before the flip); pixels right of the picture become 0 (before the flip), rows below it stay as they
/// were.
using LoadPlanesFn = void(std::uint32_t* tile, const TilePlace& place, const BitplaneStack& planes) noexcept;

/// The fastest that this machine can run for `isa`.
StorePlanesFn* store_planes_for(InstructionSet isa) noexcept;
/// How many tiles that wants at once: those of a line where it writes whole lines, else 1.
int tiles_per_store(InstructionSet isa, int tile_size) noexcept;
/// What store_planes_for() gives where whole lines have no way of their own; tests hold both against the
/// reference.
StorePlanesFn* store_planes_per_tile(InstructionSet isa) noexcept;
LoadPlanesFn* load_planes_for(InstructionSet isa) noexcept;

}  // namespace tessera::detail
