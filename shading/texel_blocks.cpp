#include "shading/texel_blocks.h"

#include <algorithm>
#include <bit>
#include <cstddef>

namespace tessera::detail {

void TexelPlaces::set_up(const TexelTile& tile, int samples, int sample) {
  const PixelRect& rect = tile.rect;
  // Blocks at the edges of the rectangle are processed whole.
  std::fill(column + (rect.x0 & ~3), column + ((rect.x1 + 3) & ~3), kNoTexel);
  std::fill(row + (rect.y0 & ~3), row + ((rect.y1 + 3) & ~3), kNoTexel);
  texel_columns(tile.texels, tile.tile_x + rect.x0, tile.tile_x + rect.x1, samples, sample, column + rect.x0);
  texel_rows(tile.texels, tile.tile_y + rect.y0, tile.tile_y + rect.y1, tile.grid.height_px, samples, sample,
             row + rect.y0);
}

bool TexelPlaces::same_in_block(const TexelPlaces& other, int bx, int by) const {
  return std::equal(column + bx, column + bx + kBlockSize, other.column + bx) &&
         std::equal(row + by, row + by + kBlockSize, other.row + by);
}

std::uint32_t TexelPlaces::covered(const PixelRectangle& texels, int bx, int by) const {
  std::uint32_t columns = 0;  // columns of the block with texels, one bit each
  for (int i = 0; i < kBlockSize; ++i) columns |= column[bx + i] != kNoTexel ? 1u << i : 0;
  std::uint32_t bits = 0;
  for (int i = 0; i < kBlockSize; ++i) bits |= row[by + i] != kNoTexel ? columns << (i * kBlockSize) : 0;
  if (texels.channels != 0) return bits;
  // Bitmap: pixels whose bit is 0 are not covered.
  for (std::uint32_t left = bits; left != 0; left &= left - 1) {
    const int p = std::countr_zero(left);
    if (!texels.bit(column[bx + p % kBlockSize], row[by + p / kBlockSize])) bits &= ~(1u << p);
  }
  return bits;
}

void TexelPlaces::fetch(const PixelRectangle& texels, int bx, int by, std::uint32_t bits,
                        float* colors) const {
  std::fill_n(colors, 4 * kBlockPixels, 0.0f);
  const bool is_grey = texels.channels < 3;
  const bool has_alpha = texels.channels % 2 == 0;
  for (std::uint32_t left = bits; left != 0; left &= left - 1) {
    const int p = std::countr_zero(left);
    const std::uint8_t* const at =
        texels.row(row[by + p / kBlockSize]) + std::ptrdiff_t{column[bx + p % kBlockSize]} * texels.channels;
    const std::uint8_t levels[4] = {at[0], at[is_grey ? 0 : 1], at[is_grey ? 0 : 2],
                                    has_alpha ? at[texels.channels - 1] : std::uint8_t{255}};
    // A division yields the float nearest to level / 255, as alpha tests against such a reference need it.
    for (int c = 0; c < 4; ++c) colors[c * kBlockPixels + p] = static_cast<float>(levels[c]) / 255.0f;
  }
}

}  // namespace tessera::detail
