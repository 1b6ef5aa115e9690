// Bitmaps and images: axis-aligned texels in the window [GL 2.1, 3.6.4, 3.7]. The texel of a window position
// is found by exact comparisons, so that a position inside the rectangle hits exactly one texel.
#pragma once

#include <cstddef>
#include <cstdint>

#include "framebuffer/tile_grid.h"

namespace tessera::detail {

struct PixelRectangle {
  double x = 0, y = 0;            ///< window coordinates of the outer corner of the bottom row's first texel
  double zoom_x = 1, zoom_y = 1;  ///< pixels per texel; negative: to the left or downwards from the corner
  int width = 0, height = 0;      ///< texels
  const std::uint8_t* top_row = nullptr;
  std::ptrdiff_t stride_bytes = 0;  ///< distance from a row to the row below it
  /// Bytes per texel: 1 grey, 2 grey and alpha, 3 RGB, 4 RGBA. 0: one bit, bit 7 of a byte leftmost.
  int channels = 0;

  const std::uint8_t* row(int from_top) const { return top_row + from_top * stride_bytes; }
  bool bit(int column, int row_from_top) const {
    return (row(row_from_top)[column / 8] >> (7 - column % 8) & 1) != 0;
  }
};

inline constexpr std::int32_t kNoTexel = -1;

/// Index of the texel, of `count`, that contains `position`, or kNoTexel. Texel n covers
/// [start + zoom n, start + zoom (n + 1)); if zoom is negative, [start + zoom (n + 1), start + zoom n).
/// @pre all arguments are finite
std::int32_t texel_at(double start, double zoom, int count, double position);

/// Bounds of the frame buffer's pixels with a sample that hits a texel. The first and last row and column
/// contain such pixels, unless the result is empty.
PixelRect covered_pixels(const PixelRectangle& texels, int frame_width, int frame_height, int samples);

/// Texel column of one sample of each pixel [x0, x1), or kNoTexel.
void texel_columns(const PixelRectangle& texels, int x0, int x1, int samples, int sample,
                   std::int32_t* columns);
/// Texel row, counted from the top, of one sample of each pixel [y0, y1) in raster space, or kNoTexel.
void texel_rows(const PixelRectangle& texels, int y0, int y1, int frame_height, int samples, int sample,
                std::int32_t* rows);

}  // namespace tessera::detail
