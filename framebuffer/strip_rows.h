// Adjacent tiles of a row of tiles, together with their bits in the planes: the input of the store kernels.
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
  // Rows are padded to a multiple of every tile size, so no column of a tile lies beyond the end of its row.
  static_assert(kLinePixels % kMaxTileSize == 0);
}

/// Bits of some pixels: their address in plane 0 and the distance from plane to plane.
template <class Byte>
struct PlaneBits {
  Byte* first;
  std::size_t plane_stride;  ///< bytes
  Byte* plane(int k) const noexcept { return first + static_cast<std::size_t>(k) * plane_stride; }
};

using StripBits = PlaneBits<std::uint8_t>;

/// Adjacent tiles and their bits in the planes.
struct StripRows {
  std::span<const std::uint32_t* const> tiles;
  int tile_size;
  int width_px, height_px;      ///< part inside the picture
  StripBits bits;               ///< bits of the top left pixel
  std::ptrdiff_t stride_bytes;  ///< row stride of the planes

  /// The part that tile t covers.
  StripRows only(std::size_t t) const noexcept {
    const int x = static_cast<int>(t) * tile_size;
    return {tiles.subspan(t, 1),
            tile_size,
            std::min(tile_size, width_px - x),
            height_px,
            {bits.first + x / 8, bits.plane_stride},
            stride_bytes};
  }
  /// Address of pixel x, a multiple of 4, in row y. Within a tile, pixel x + 4 is kBlockPixels further on.
  /// Beyond the last tile the result points to some pixel of that tile; the caller masks it out.
  const std::uint32_t* pixels(int x, int y) const noexcept {
    const std::size_t tile = std::min(
        static_cast<std::size_t>(x) >> std::countr_zero(static_cast<unsigned>(tile_size)), tiles.size() - 1);
    return tiles[tile] + tile_index(x & (tile_size - 1), y, tile_size);
  }
};

}  // namespace tessera::detail
