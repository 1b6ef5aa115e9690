// Window space in fixed point: grid, guard band, and the widths of triangles whose edge functions fit 32
// bits.
//
// Raster space is window space with rows counted from the top: x to the right, y down, in units of 1/256
// pixel; the pixel (i, j) has its centre at (256 i + 128, 256 j + 128).
#pragma once

#include <cstdint>

#include "framebuffer/tile_grid.h"

namespace tessera::detail {

inline constexpr int kSubpixelBits = 8;
inline constexpr int kSubpixelScale = 1 << kSubpixelBits;
inline constexpr int kHalfPixel = kSubpixelScale / 2;

/// Largest width and height of a viewport, in pixels.
inline constexpr int kMaxViewportPixels = 16384;
/// Vertices are kept within this many pixels of the viewport's centre; what reaches farther is clipped. So
/// the guard band is at least half a viewport wide on each side.
inline constexpr int kGuardBandPixels = 16383;
static_assert(kGuardBandPixels >= kMaxViewportPixels - 1);
/// A viewport's corner lies within this many pixels of the frame buffer's.
inline constexpr int kMaxViewportOffset = 32768;
static_assert((std::int64_t{kGuardBandPixels} + kMaxViewportPixels / 2 + kMaxViewportOffset + 1) *
                      kSubpixelScale <=
                  (1 << 24),
              "a coordinate fits 24 bits and a sign");

/// Largest extent, in pixels, of a triangle between any two vertices after clipping.
inline constexpr std::int64_t kMaxTriangleExtent = 2 * kGuardBandPixels;
static_assert((kMaxTriangleExtent + kMaxTileSize + 1) * kSubpixelScale <= (1 << 24),
              "from a vertex to a pixel of a tile that the triangle touches is exact in a float");

// An edge function is E(p) = A (px - vx) + B (py - vy), with A and B differences of coordinates. Divided by
// 256 and rounded down, E at pixel centres keeps its sign and steps by exactly A and B from pixel to pixel.
//
// Narrow triangles: at a pixel within `extent` + one tile of the triangle, |A|, |B| <= 256 extent, so
// |E / 256| <= 2 * 256 extent * (extent + one tile). A sample, less than a pixel from the centre, adds less
// than 2 * 256 extent.
inline constexpr std::int64_t kMaxEdges32Extent = 1984;
constexpr std::int64_t edges32_bound(std::int64_t extent) {
  return 2 * kSubpixelScale * extent * (extent + kMaxTileSize + 1);
}
static_assert(edges32_bound(kMaxEdges32Extent) <= INT32_MAX &&
                  edges32_bound(kMaxEdges32Extent + 1) > INT32_MAX,
              "the widest that fits, and not a pixel more");
// All others: an edge that crosses a tile is smaller in the whole tile than its own span from the first
// pixel's centre to the last one's.
static_assert((kMaxTileSize - 1) * 2 * kMaxTriangleExtent * kSubpixelScale <= INT32_MAX,
              "an edge that crosses a tile fits 32 bits in it");
// Twice a triangle's area is exact in a double.
static_assert(2 * (kMaxTriangleExtent * kSubpixelScale) * (kMaxTriangleExtent * kSubpixelScale) <
              (std::int64_t{1} << 53));
// Binning looks at the undivided edges at the corners of tiles, in 64 bits.
static_assert(2 * (kMaxTriangleExtent * kSubpixelScale) *
                  ((kMaxTriangleExtent + 2 * kMaxTileSize) * kSubpixelScale) <
              INT64_MAX / 4);
// The numerators of a depth plane: two products of a coordinate's difference and a depth word's.
static_assert(2 * kMaxTriangleExtent * kSubpixelScale * std::int64_t{0xffffffff} < (std::int64_t{1} << 57));

/// A vertex after projection and snapping.
struct WindowVertex {
  std::int32_t x = 0, y = 0;  ///< raster space, 1/256 pixel
  /// Depth. Unorm formats of b bits: floor((z (2^b - 1) + 0.5) * 2^(32 - b)), so that the top b bits are the
  /// stored level; float32: the bits of the float.
  std::uint32_t z = 0;
  float rw = 1;  ///< 1/w
};
static_assert(sizeof(WindowVertex) == 16);

// By value, unlike std::min and max, of whose references no lanes are made.
constexpr std::int32_t min_of(std::int32_t a, std::int32_t b) { return a < b ? a : b; }
constexpr std::int32_t min_of(std::int32_t a, std::int32_t b, std::int32_t c) {
  return min_of(a, min_of(b, c));
}
constexpr std::int32_t max_of(std::int32_t a, std::int32_t b) { return a > b ? a : b; }
constexpr std::int32_t max_of(std::int32_t a, std::int32_t b, std::int32_t c) {
  return max_of(a, max_of(b, c));
}

// Pixels whose centres lie in [low, high], in 1/256 pixel.
constexpr int first_pixel(std::int32_t low) { return (low + kHalfPixel - 1) >> kSubpixelBits; }
constexpr int last_pixel(std::int32_t high) { return (high - kHalfPixel) >> kSubpixelBits; }

}  // namespace tessera::detail
