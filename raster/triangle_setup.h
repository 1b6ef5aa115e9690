// What triangle setup yields: groups of triangles as arrays, and the edges of one triangle in one tile.
#pragma once

#include <cstdint>

#include "framebuffer/tile_grid.h"
#include "raster/fixed_point.h"
#include "raster/sample_positions.h"

namespace tessera::detail {

inline constexpr int kGroupSize = 16;  ///< triangles set up at a time

// Planes of unorm depth are 32.32 fixed point modulo 2^64.
inline constexpr int kUnormFraction = 32;
/// Unorm32 uses the whole depth word, so there is no margin at the ends: 34.30 fixed point, lifted by 2^32
/// and cut to range.
inline constexpr int kUnorm32Fraction = 30;
inline constexpr std::int64_t kUnorm32RangeBias = std::int64_t{1} << 32;
// Planes are lifted by what rounding may take from them, so that at no pixel they fall below the least of the
// vertices' words, where a level may end; above the greatest there is room for both. For nearly all triangles
// a 2^-19th of a word is enough.
inline constexpr std::int64_t kUnormRoundingBias = std::int64_t{1} << (kUnormFraction - 19),
                              kUnorm32RoundingBias = std::int64_t{1} << (kUnorm32Fraction - 19);

/// A vertex weighs at least so much of the heaviest one, by 1/w: the products with 1/area stay normal floats,
/// and on the edge opposite to that one, where the others alone have weight, their sum is not 0.
inline constexpr float kMinWeight = 0x1p-64f;

/// Index k of a, b, e, ... is the edge opposite vertex k; edges are positive inside, whatever the winding.
struct TriangleGroup {
  int count = 0;
  // Read from the vertices.
  alignas(64) std::int32_t x[3][kGroupSize], y[3][kGroupSize];  ///< raster space, 1/256 pixel
  alignas(64) std::uint32_t z[3][kGroupSize];
  alignas(64) float rw[3][kGroupSize];
  // Edges at pixel centres, divided by 256 and rounded down, the fill rule's bias included: E(x, y) = e + a x
  // + b y with x, y counted in pixels from the tile's first. Exact for narrow triangles.
  alignas(64) std::int32_t a[3][kGroupSize], b[3][kGroupSize], e[3][kGroupSize];
  alignas(64) float edge_fraction[3][kGroupSize];  ///< the exact edge is 256 E + edge_fraction, without the
                                                   ///< bias; 0 .. 256
  alignas(64) std::int32_t flip[kGroupSize];
  alignas(64) double signed_area[kGroupSize], area[kGroupSize];  ///< doubled area, exact
  alignas(64) std::int32_t x0[kGroupSize], y0[kGroupSize], x1[kGroupSize],
      y1[kGroupSize];  ///< pixel bounds in the tile, inclusive
  alignas(64) std::int32_t needs_edges64[kGroupSize], affine[kGroupSize];
  // Depth planes: float32 as they are, unorm in fixed point modulo 2^64 with the value at the tile's first
  // pixel; see depth-inl.h. They are anchored at the topmost vertex, the leftmost of those, so that the order
  // of the vertices does not change their roundings.
  alignas(64) std::int32_t anchor_x[kGroupSize], anchor_y[kGroupSize];
  alignas(64) std::uint32_t anchor_z[kGroupSize];
  alignas(64) double depth_dx[kGroupSize], depth_dy[kGroupSize];
  alignas(64) std::uint64_t fixed_dx[kGroupSize], fixed_dy[kGroupSize], fixed_base[kGroupSize];
  alignas(64) float scale[3][kGroupSize], shift[3][kGroupSize], unit_scale[3][kGroupSize];
  std::uint32_t mask = 0;             ///< those with a pixel in the tile
  std::uint32_t extra_bias_mask = 0;  ///< of these, those whose unorm depth is rounded by more than planes
                                      ///< are lifted by, and so lifted further
  std::uint32_t exact_depth_mask =
      0;  ///< of those, the ones whose unorm depth is worked out in exact integers
  std::uint64_t extra_bias[kGroupSize];  ///< triangles of extra_bias_mask
};

/// What differs of a group from sample to sample: edges, and the value of unorm depth planes at the tile's
/// first pixel.
struct SampleGroup {
  alignas(64) std::int32_t max_edge[3][kGroupSize];  ///< e of the sample that has the greatest
  alignas(64) std::int32_t
      edge_delta[kMaxSamples][3][kGroupSize];  ///< what a sample's e has more than that: 0 or less
  alignas(64) std::uint64_t fixed_base[kMaxSamples][kGroupSize];
};

/// The three edges of one triangle in one tile, in 32 bits: exact at every pixel of the triangle's bounds in
/// the tile.
struct Edges32 {
  std::int32_t a[4], b[4], e[4];  ///< of three; lanes are loaded in fours
  /// Edge k at a pixel of the tile. Sums may wrap on their way there.
  std::int32_t at(int k, int x, int y) const {
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(e[k]) +
                                     static_cast<std::uint32_t>(a[k]) * static_cast<std::uint32_t>(x) +
                                     static_cast<std::uint32_t>(b[k]) * static_cast<std::uint32_t>(y));
  }
};

/// The edges of a wide triangle: doubles hold every value exactly.
struct Edges64 {
  double a[3], b[3], e[3];  ///< undivided edge at pixel (x, y) of the tile: e + a x + b y
};

}  // namespace tessera::detail
