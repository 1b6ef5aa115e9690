// Neighbouring tiles of a row and the planes' bits that belong to them, as kernels that store them go through
// both.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include "framebuffer/bit_transpose.h"
#include "framebuffer/check.h"
#include "framebuffer/tile_grid.h"

namespace tessera::detail {

inline void assert_tile_fits([[maybe_unused]] const TilePlace& place,
                             [[maybe_unused]] const BitplaneStack& planes) noexcept {
  TESSERA_ASSERT(place.tile_size == 32 || place.tile_size == 64 || place.tile_size == 128);
  TESSERA_ASSERT(place.x0_px >= 0 && place.x0_px < planes.width_px() && place.x0_px % place.tile_size == 0);
  TESSERA_ASSERT(place.y0_px >= 0 && place.y0_px < planes.height_px() && place.y0_px % place.tile_size == 0);
  // Rows are padded to a multiple of every tile size, so that no column of a tile falls off the end of its
  // row.
  static_assert(kLinePixels % kMaxTileSize == 0);
}

/// The bits of some pixels in plane 0, and the way from there to the other planes.
template <class Byte>
struct PlaneBits {
  Byte* first;
  std::size_t plane_stride;
  Byte* plane(int k) const noexcept { return first + static_cast<std::size_t>(k) * plane_stride; }
};

using StripBits = PlaneBits<std::uint8_t>;

struct StripRows {
  std::span<const std::uint32_t* const> tiles;
  int tile_size;
  int width_px, height_px;      ///< of what lies in the picture
  StripBits bits;               ///< of the top left pixel
  std::ptrdiff_t stride_bytes;  ///< of the planes' rows

  /// Of tile t alone.
  StripRows only(std::size_t t) const noexcept {
    const int x = static_cast<int>(t) * tile_size;
    return {tiles.subspan(t, 1),
            tile_size,
            std::min(tile_size, width_px - x),
            height_px,
            {bits.first + x / 8, bits.plane_stride},
            stride_bytes};
  }
  /// Of pixel x, a multiple of 4, of row y; in the same tile those of pixel x + 4 come kBlockPixels later.
  /// Behind the last tile it is some pixel of that, for those who mask it away.
  const std::uint32_t* pixels(int x, int y) const noexcept {
    const std::size_t tile = std::min(
        static_cast<std::size_t>(x) >> std::countr_zero(static_cast<unsigned>(tile_size)), tiles.size() - 1);
    return tiles[tile] + tile_index(x & (tile_size - 1), y, tile_size);
  }
};

}  // namespace tessera::detail
