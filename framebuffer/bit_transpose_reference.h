// Scalar twins of bit_transpose.h, pixel by pixel.
#pragma once

#include <algorithm>

#include "framebuffer/bit_transpose.h"
#include "framebuffer/tile_grid.h"

namespace tessera::detail {

inline void store_planes_reference(const std::uint32_t* tile, const TilePlace& place, BitplaneStack& planes,
                                   std::uint32_t plane_store_mask) noexcept {
  for (int y = 0; y < place.tile_size && place.y0_px + y < planes.height_px(); ++y)
    for (int x = 0; x < place.tile_size && place.x0_px + x < planes.width_px(); ++x) {
      const std::uint32_t incoming = tile[tile_index(x, y, place.tile_size)] ^ place.flip;
      const std::uint32_t stored = planes.pixel(place.x0_px + x, place.y0_px + y);
      planes.set_pixel(place.x0_px + x, place.y0_px + y,
                       (stored & ~plane_store_mask) | (incoming & plane_store_mask));
    }
}

inline void load_planes_reference(std::uint32_t* tile, const TilePlace& place,
                                  const BitplaneStack& planes) noexcept {
  for (int y = 0; y < place.tile_size && place.y0_px + y < planes.height_px(); ++y)
    for (int x = 0; x < place.tile_size; ++x) {
      const bool inside = place.x0_px + x < planes.width_px();
      tile[tile_index(x, y, place.tile_size)] =
          (inside ? planes.pixel(place.x0_px + x, place.y0_px + y) : 0) ^ place.flip;
    }
}

}  // namespace tessera::detail
