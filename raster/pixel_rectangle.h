// Bitmaps and images: texels that stand upright in the window. Which of them a place in the window sees is
// decided by exact comparisons, so that no place between two texels sees both or neither
// [GL 2.1, 3.6.4, 3.7].
#pragma once

#include <cstddef>
#include <cstdint>

#include "framebuffer/tile_grid.h"

namespace tessera::detail {

struct PixelRectangle {
  double x = 0,
         y = 0;  ///< window coordinates of the corner where the columns and, from below, the rows begin
  double zoom_x = 1, zoom_y = 1;  ///< pixels a texel; below 0 it goes to the left or downwards from there
  int width = 0, height = 0;      ///< texels
  const std::uint8_t* top_row = nullptr;
  std::ptrdiff_t stride_bytes = 0;  ///< from a row to the one below it
  int channels =
      0;  ///< bytes a texel: grey, grey and alpha, r g b, r g b a; 0: a bit, the highest of a byte leftmost

  const std::uint8_t* row(int from_top) const { return top_row + from_top * stride_bytes; }
  bool bit(int column, int row_from_top) const {
    return (row(row_from_top)[column / 8] >> (7 - column % 8) & 1) != 0;
  }
};

inline constexpr std::int32_t kNoTexel = -1;

/// Which of `count` texels covers a place: n does from start + zoom n, included, to start + zoom (n + 1), or
/// the other way round where zoom is below 0. @pre all are finite
std::int32_t texel_at(double start, double zoom, int count, double place);

/// The pixels of a frame buffer of which some sample may see a texel; the first and last row and column do,
/// unless they are one.
PixelRect covered_pixels(const PixelRectangle& texels, int frame_width, int frame_height, int samples);

/// The columns that pixels [x0, x1) see, of one of a pixel's samples; or kNoTexel.
void texel_columns(const PixelRectangle& texels, int x0, int x1, int samples, int sample,
                   std::int32_t* columns);
/// The rows, counted from the top one, that pixels [y0, y1) of raster space see.
void texel_rows(const PixelRectangle& texels, int y0, int y1, int frame_height, int samples, int sample,
                std::int32_t* rows);

}  // namespace tessera::detail
