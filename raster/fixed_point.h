// Raster space in fixed point: grid, guard band, and the bounds of edge functions.
//
// Raster space is window space with rows counted from the top: x to the right, y down, in units of 1/256
// pixel. The centre of pixel (i, j) is (256 i + 128, 256 j + 128).
#pragma once

#include <cstdint>

#include "framebuffer/tile_grid.h"

namespace tessera::detail {

inline constexpr int kSubpixelBits = 8;
inline constexpr int kSubpixelScale = 1 << kSubpixelBits;
inline constexpr int kHalfPixel = kSubpixelScale / 2;

/// Largest width and height of a viewport, in pixels.
inline constexpr int kMaxViewportPixels = 16384;
/// Half size of the guard band: triangles are clipped to this distance, in pixels, from the viewport's
/// centre. The band extends at least half a viewport beyond each side.
inline constexpr int kGuardBandPixels = 16383;
static_assert(kGuardBandPixels >= kMaxViewportPixels - 1);
/// Largest distance, in pixels and per axis, of a viewport's corner from the frame buffer's.
inline constexpr int kMaxViewportOffset = 32768;
static_assert((std::int64_t{kGuardBandPixels} + kMaxViewportPixels / 2 + kMaxViewportOffset + 1) *
                      kSubpixelScale <=
                  (1 << 24),
              "a coordinate fits in 24 bits and a sign");

/// Largest extent, in pixels, of a triangle between any two vertices after clipping.
inline constexpr std::int64_t kMaxTriangleExtent = 2 * kGuardBandPixels;
static_assert(
    (kMaxTriangleExtent + kMaxTileSize + 1) * kSubpixelScale <= (1 << 24),
    "the distance from a vertex to a pixel of a tile that the triangle touches is exact in a float");

// An edge function is E(p) = A (px - vx) + B (py - vy), with A and B differences of coordinates. Divided by
// 256 and rounded down, E at pixel centres keeps its sign and steps by exactly A and B from pixel to pixel.
//
// 32-bit edges: at a pixel within `extent` + one tile of the triangle, |A|, |B| <= 256 extent, so
// |E / 256| <= 2 * 256 extent * (extent + one tile). A sample, less than a pixel from the centre, adds less
// than 2 * 256 extent.

/// Largest extent, in pixels, of a triangle whose edges fit in 32 bits everywhere in the tiles that it
/// touches.
inline constexpr std::int64_t kMaxEdges32Extent = 1984;
constexpr std::int64_t edges32_bound(std::int64_t extent) {
  return 2 * kSubpixelScale * extent * (extent + kMaxTileSize + 1);
}
static_assert(edges32_bound(kMaxEdges32Extent) <= INT32_MAX &&
                  edges32_bound(kMaxEdges32Extent + 1) > INT32_MAX,
              "the largest extent that fits");
// 64-bit edges: in a tile that the edge crosses, |E| is smaller than the edge's range from the first pixel's
// centre to the last one's.
static_assert((kMaxTileSize - 1) * 2 * kMaxTriangleExtent * kSubpixelScale <= INT32_MAX,
              "an edge that crosses a tile fits in 32 bits there");
// Twice a triangle's area is exact in a double.
static_assert(2 * (kMaxTriangleExtent * kSubpixelScale) * (kMaxTriangleExtent * kSubpixelScale) <
              (std::int64_t{1} << 53));
// Binning evaluates the undivided edges at the corners of tiles, in 64 bits.
static_assert(2 * (kMaxTriangleExtent * kSubpixelScale) *
                  ((kMaxTriangleExtent + 2 * kMaxTileSize) * kSubpixelScale) <
              INT64_MAX / 4);
// Numerator of a depth gradient: two products of a coordinate difference and a difference of depth words.
static_assert(2 * kMaxTriangleExtent * kSubpixelScale * std::int64_t{0xffffffff} < (std::int64_t{1} << 57));

/// A vertex after projection and snapping to the grid.
struct WindowVertex {
  std::int32_t x = 0, y = 0;  ///< raster space, 1/256 pixel
  /// Depth word. Unorm formats of b bits: (z (2^b - 1) + 0.5) * 2^(32 - b), rounded to the nearest integer
  /// within the same level, so that the top b bits are the stored level. float32: the bits of the float.
  std::uint32_t z = 0;
  float rw = 1;  ///< 1/w
};
static_assert(sizeof(WindowVertex) == 16);

// By value: loops over std::min and std::max, which return references, are not vectorized.
constexpr std::int32_t min_of(std::int32_t a, std::int32_t b) { return a < b ? a : b; }
constexpr std::int32_t min_of(std::int32_t a, std::int32_t b, std::int32_t c) {
  return min_of(a, min_of(b, c));
}
constexpr std::int32_t max_of(std::int32_t a, std::int32_t b) { return a > b ? a : b; }
constexpr std::int32_t max_of(std::int32_t a, std::int32_t b, std::int32_t c) {
  return max_of(a, max_of(b, c));
}

// First and last pixel whose centre lies in [low, high], in 1/256 pixel.
constexpr int first_pixel(std::int32_t low) { return (low + kHalfPixel - 1) >> kSubpixelBits; }
constexpr int last_pixel(std::int32_t high) { return (high - kHalfPixel) >> kSubpixelBits; }

}  // namespace tessera::detail
