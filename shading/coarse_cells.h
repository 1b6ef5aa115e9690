// Cells of coarse shading in a block of 4x4 pixels: four of 2x2 pixels, or one of 4x4.
#pragma once

#include <array>
#include <bit>
#include <cstdint>

#include "framebuffer/tile_grid.h"
#include "shading/lighting.h"

namespace tessera::detail {

/// Cells that are lit together.
struct CellBatch {
  ShadingBatch points;
  int count = 0;

  /// Whether all cells of another block fit.
  bool has_room() const { return count <= kBatchPoints - kBlockPixels; }
};

/// Blocks of a surface in deferred shading whose cells are lit together.
struct CoarseBlocks {
  static constexpr int kCapacity = 64;
  int count = 0;
  int index[kCapacity];  ///< the block's first pixel in the tile
  int bx[kCapacity], by[kCapacity];
  std::uint32_t covered[kCapacity];  ///< pixels of the surface, 16 bits
  alignas(64) std::int32_t
      visibility[kCapacity * kBlockPixels];  ///< copy of the visibility buffer, for textures
  /// Numbers in the CellBatch. Those of pixels that are not covered are any numbers in it.
  alignas(64) std::int32_t cell_of_pixel[kCapacity * kBlockPixels] = {};
};

constexpr int cells_per_block(int size) { return size == 2 ? 4 : 1; }

// Column and row of the first pixel of each cell; padded for whole vectors.
alignas(64) inline constexpr std::int32_t kColumnOf2x2[16] = {0, 2, 0, 2, 0, 2, 0, 2, 0, 2, 0, 2, 0, 2, 0, 2};
alignas(64) inline constexpr std::int32_t kRowOf2x2[16] = {0, 0, 2, 2, 0, 0, 2, 2, 0, 0, 2, 2, 0, 0, 2, 2};
alignas(64) inline constexpr std::int32_t kFirstOf4x4[16] = {};
constexpr const std::int32_t* cell_columns(int size) { return size == 2 ? kColumnOf2x2 : kFirstOf4x4; }
constexpr const std::int32_t* cell_rows(int size) { return size == 2 ? kRowOf2x2 : kFirstOf4x4; }

/// Pixels of a cell, 16 bits.
constexpr std::uint32_t pixels_of_cell(int size, int cell) {
  return size == 2 ? 0x0033u << (2 * (cell & 1) + 8 * (cell >> 1)) : 0xffffu;
}

/// Cells that contain one of some pixels, one bit each.
constexpr std::uint32_t cells_of_pixels(int size, std::uint32_t pixels) {
  if (size != 2) return pixels != 0 ? 1 : 0;
  std::uint32_t cells = 0;
  for (int cell = 0; cell < 4; ++cell)
    if ((pixels & pixels_of_cell(2, cell)) != 0) cells |= 1u << cell;
  return cells;
}

/// The pixel of a cell that is nearest to the cell's centre among `covered`, 16 bits; of several, the first.
/// -1: none.
constexpr int first_covered_pixel(int size, int cell, std::uint32_t covered) {
  // In a cell of 4x4 pixels: distances of 0.7, 1.6 and 2.1 pixels from the centre.
  constexpr std::uint32_t kInner = 0x0660, kSides = 0x6996, kCorners = 0x9009;
  const std::uint32_t pixels = covered & pixels_of_cell(size, cell);
  if (pixels == 0) return -1;
  if (size == 2) return std::countr_zero(pixels);
  for (const std::uint32_t ring : {kInner, kSides, kCorners})
    if ((pixels & ring) != 0) return std::countr_zero(pixels & ring);
  return -1;
}

/// Per pixel of a block: how many of some cells precede the pixel's cell.
using CellRanks = std::array<std::int32_t, kBlockPixels>;
/// Ranks of cells of 2x2 pixels, by the bits of the cells.
struct alignas(64) CellRankTable {
  CellRanks of[16];
};
inline constexpr CellRankTable kCellRanks = [] {
  CellRankTable table{};
  for (std::uint32_t cells = 0; cells < 16; ++cells)
    for (std::uint32_t p = 0; p < kBlockPixels; ++p) {
      const std::uint32_t cell = p % 4 / 2 + 2 * (p / 8);
      table.of[cells][p] = std::popcount(cells & ((1u << cell) - 1));
    }
  return table;
}();
/// @param cells  one bit each
constexpr const std::int32_t* cell_ranks(int size, std::uint32_t cells) {
  return size == 2 ? kCellRanks.of[cells].data() : kFirstOf4x4;
}

}  // namespace tessera::detail
