// Results of triangle setup: groups of triangles as arrays, and the edges of one triangle in one tile.
#pragma once

#include <cstdint>

#include "framebuffer/tile_grid.h"
#include "raster/fixed_point.h"
#include "raster/sample_positions.h"

namespace tessera::detail {

inline constexpr int kGroupSize = 16;  ///< triangles set up at a time

/// unorm16, unorm24: depth planes are 32.32 fixed point modulo 2^64, in depth words.
inline constexpr int kUnormFraction = 32;
/// unorm32 uses the whole depth word and so has no margin at the ends of the range: 34.30 fixed point, biased
/// by 2^32 and clamped to the range.
inline constexpr int kUnorm32Fraction = 30;
inline constexpr std::int64_t kUnorm32RangeBias = std::int64_t{1} << 32;
// Planes are biased by a bound of their rounding error, so that at no pixel they fall below the smallest of
// the vertices' depth words, which may be the lower end of a level. Above the largest there is room for bias
// and error. A bias of 2^-19 depth words suffices for nearly all triangles.
inline constexpr std::int64_t kUnormRoundingBias = std::int64_t{1} << (kUnormFraction - 19);
inline constexpr std::int64_t kUnorm32RoundingBias = std::int64_t{1} << (kUnorm32Fraction - 19);

/// Smallest 1/w of a vertex, relative to the triangle's largest; smaller ones are raised to it. Products with
/// 1/area then stay normal floats, and on the edge opposite the vertex with the largest 1/w the sum of
/// weights is not 0.
inline constexpr float kMinWeight = 0x1p-64f;

/// Triangles of a group in a tile. "The tile's first pixel" is its top left one; pixel coordinates count from
/// it. Edge k, index k of its fields, lies opposite vertex k. Edges are positive inside for both windings.
struct TriangleGroup {
  int count = 0;

  // Vertices: the input of triangle setup.
  alignas(64) std::int32_t x[3][kGroupSize], y[3][kGroupSize];  ///< raster space, 1/256 pixel
  alignas(64) std::uint32_t z[3][kGroupSize];                   ///< depth words
  alignas(64) float rw[3][kGroupSize];                          ///< 1/w

  // Edge functions at pixel centres, plus the bias of the fill rule, divided by 256 and rounded down:
  // E(x, y) = e + a x + b y at pixel (x, y). Exact for triangles with 32-bit edges.
  alignas(64) std::int32_t a[3][kGroupSize];
  alignas(64) std::int32_t b[3][kGroupSize];
  alignas(64) std::int32_t e[3][kGroupSize];
  /// The exact edge function without the bias is 256 E + edge_fraction; 0 .. 256.
  alignas(64) float edge_fraction[3][kGroupSize];
  alignas(64) std::int32_t flip[kGroupSize];  ///< -1: signed_area is negative, a and b are negated; else 0

  alignas(64) double signed_area[kGroupSize];  ///< doubled area, exact
  alignas(64) double area[kGroupSize];         ///< |signed_area|
  // Bounds: first and last pixel in the tile, inclusive.
  alignas(64) std::int32_t x0[kGroupSize], y0[kGroupSize], x1[kGroupSize], y1[kGroupSize];
  alignas(64) std::int32_t needs_edges64[kGroupSize];  ///< 1: edges do not fit in 32 bits
  alignas(64) std::int32_t affine[kGroupSize];  ///< 1: weights are barycentric coordinates, without 1/w

  // Depth planes; see depth-inl.h. The anchor is the topmost vertex, and the leftmost of several, so that
  // rounding does not depend on the order of the vertices.
  alignas(64) std::int32_t anchor_x[kGroupSize], anchor_y[kGroupSize];  ///< raster space, 1/256 pixel
  alignas(64) std::uint32_t anchor_z[kGroupSize];                       ///< depth word
  /// Gradients per pixel, in depth words (unorm) or in depth (float32).
  alignas(64) double depth_dx[kGroupSize], depth_dy[kGroupSize];
  // Unorm planes in fixed point modulo 2^64: steps per pixel, and the value at the tile's first pixel.
  alignas(64) std::uint64_t fixed_dx[kGroupSize], fixed_dy[kGroupSize];
  alignas(64) std::uint64_t fixed_base[kGroupSize];

  // Weights, see set_up_weights().
  alignas(64) float scale[3][kGroupSize];       ///< per unit of E
  alignas(64) float shift[3][kGroupSize];       ///< weight at E = 0
  alignas(64) float unit_scale[3][kGroupSize];  ///< per unit of the undivided edge function

  std::uint32_t mask = 0;  ///< triangles with a pixel in the tile
  /// Triangles of `mask` whose error bound of unorm depth exceeds the rounding bias; their plane gets
  /// extra_bias.
  std::uint32_t extra_bias_mask = 0;
  /// Triangles of extra_bias_mask whose unorm depth is computed in exact integers.
  std::uint32_t exact_depth_mask = 0;
  std::uint64_t extra_bias[kGroupSize];  ///< set for triangles of extra_bias_mask
};

/// Per-sample part of a group. Samples share the steps a, b, fixed_dx and fixed_dy of TriangleGroup.
struct SampleGroup {
  alignas(64) std::int32_t max_edge[3][kGroupSize];                 ///< largest e of all samples
  alignas(64) std::int32_t edge_delta[kMaxSamples][3][kGroupSize];  ///< e of the sample minus max_edge; <= 0
  alignas(64) std::uint64_t fixed_base[kMaxSamples][kGroupSize];    ///< unorm plane at the tile's first pixel
};

/// The edges of one triangle in one tile, in 32 bits. Exact at every pixel of its bounds in the tile.
struct Edges32 {
  std::int32_t a[4], b[4], e[4];  ///< three are used; four are loaded at once
  /// Edge k at a pixel of the tile. Intermediate sums may wrap.
  std::int32_t at(int k, int x, int y) const {
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(e[k]) +
                                     static_cast<std::uint32_t>(a[k]) * static_cast<std::uint32_t>(x) +
                                     static_cast<std::uint32_t>(b[k]) * static_cast<std::uint32_t>(y));
  }
};

/// The edges of a triangle that needs 64 bits. Doubles hold all values exactly.
struct Edges64 {
  double a[3], b[3], e[3];  ///< undivided edge at pixel (x, y) of the tile: e + a x + b y
};

}  // namespace tessera::detail
