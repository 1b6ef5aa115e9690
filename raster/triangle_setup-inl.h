// Triangle setup in a tile, a group at a time: edge functions with the fill rule, bounds, depth gradients,
// weights. Plain loops over the arrays of a group, which the compiler vectorizes.
//
// Based on: J. Pineda, A Parallel Algorithm for Polygon Rasterization, SIGGRAPH 1988. Differs in that edges
// are exact integers, divided by 256 without losing their sign.
#if defined(TESSERA_RASTER_TRIANGLE_SETUP_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TESSERA_RASTER_TRIANGLE_SETUP_INL_H_
#undef TESSERA_RASTER_TRIANGLE_SETUP_INL_H_
#else
#define TESSERA_RASTER_TRIANGLE_SETUP_INL_H_
#endif

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "framebuffer/format.h"
#include "framebuffer/tile_grid.h"
#include "raster/fixed_point.h"
#include "raster/lanes-inl.h"
#include "raster/sample_positions.h"
#include "raster/triangle_setup.h"

HWY_BEFORE_NAMESPACE();
namespace tessera::detail {
namespace HWY_NAMESPACE {

/// Mask of the triangles of a group whose element in `numbers` is not 0.
HWY_INLINE std::uint32_t nonzero_mask(const std::int32_t (&numbers)[kGroupSize]) {
  std::uint32_t bits = 0;
  for (int first = 0; first < kGroupSize; first += kLanes)
    bits |= mask_bits(kInt, hn::Ne(hn::Load(kInt, numbers + first), hn::Zero(kInt))) << first;
  return bits;
}

HWY_INLINE void set_up_areas(TriangleGroup& g) {
  for (int i = 0; i < kGroupSize; ++i) {
    const double dx1 = g.x[1][i] - g.x[0][i], dy1 = g.y[1][i] - g.y[0][i];
    const double dx2 = g.x[2][i] - g.x[0][i], dy2 = g.y[2][i] - g.y[0][i];
    const double area = dx1 * dy2 - dx2 * dy1;  // exact
    g.signed_area[i] = area;
    g.area[i] = area < 0 ? -area : area;
    g.flip[i] = area < 0 ? -1 : 0;
  }
}

/// -value if `flip` is -1, value if it is 0.
HWY_INLINE std::int32_t flipped(std::int32_t value, std::int32_t flip) { return (value ^ flip) - flip; }

/// Sets up edge functions. Intermediate products and sums may wrap: they are unsigned.
HWY_INLINE void set_up_edge_functions(TriangleGroup& g, int tile_x, int tile_y) {
  for (int k = 0; k < 3; ++k) {
    // The edge opposite vertex k, from vertex p to vertex q.
    const std::int32_t *px = g.x[(k + 1) % 3], *py = g.y[(k + 1) % 3];
    const std::int32_t *qx = g.x[(k + 2) % 3], *qy = g.y[(k + 2) % 3];
    for (int i = 0; i < kGroupSize; ++i) {
      const std::int32_t flip = g.flip[i];
      const std::int32_t a = flipped(py[i] - qy[i], flip), b = flipped(qx[i] - px[i], flip);
      // Top-left rule: a pixel centre on a left edge (inside to its right) or a top edge (inside below it)
      // belongs to the triangle.
      const bool top_left = a > 0 || (a == 0 && b > 0);
      const std::uint32_t ua = static_cast<std::uint32_t>(a), ub = static_cast<std::uint32_t>(b);
      // The undivided edge at the centre of the pixel that contains p.
      const std::int32_t at_pixel_of_p =
          static_cast<std::int32_t>(ua * static_cast<std::uint32_t>(kHalfPixel - (px[i] & 255)) +
                                    ub * static_cast<std::uint32_t>(kHalfPixel - (py[i] & 255)));
      const std::int32_t e = (at_pixel_of_p + (top_left ? 0 : -1)) >> kSubpixelBits;
      g.edge_fraction[k][i] = static_cast<float>(at_pixel_of_p - e * kSubpixelScale);
      g.a[k][i] = a;
      g.b[k][i] = b;
      // From the pixel of p to the tile's first pixel. Wraps if that is far away; the wrap cancels at the
      // pixels of the triangle's bounds (kMaxEdges32Extent).
      g.e[k][i] = static_cast<std::int32_t>(static_cast<std::uint32_t>(e) +
                                            ua * static_cast<std::uint32_t>(tile_x - (px[i] >> 8)) +
                                            ub * static_cast<std::uint32_t>(tile_y - (py[i] >> 8)));
    }
  }
}

/// Sets up bounds, needs_edges64 and mask.
HWY_INLINE void set_up_bounds(TriangleGroup& g, int tile_x, int tile_y, const PixelRect& rect,
                              std::int32_t reach) {
  alignas(64) std::int32_t visible[kGroupSize];
  const PixelRect bounds = rect;  // local copy: possible aliasing would prevent vectorization
  constexpr auto kMaxExtent = static_cast<std::int32_t>(kMaxEdges32Extent) * kSubpixelScale;
  for (int i = 0; i < kGroupSize; ++i) {
    const std::int32_t low_x = min_of(g.x[0][i], g.x[1][i], g.x[2][i]);
    const std::int32_t high_x = max_of(g.x[0][i], g.x[1][i], g.x[2][i]);
    const std::int32_t low_y = min_of(g.y[0][i], g.y[1][i], g.y[2][i]);
    const std::int32_t high_y = max_of(g.y[0][i], g.y[1][i], g.y[2][i]);
    g.x0[i] = max_of(first_pixel(low_x - reach) - tile_x, bounds.x0);
    g.y0[i] = max_of(first_pixel(low_y - reach) - tile_y, bounds.y0);
    g.x1[i] = min_of(last_pixel(high_x + reach) - tile_x, bounds.x1 - 1);
    g.y1[i] = min_of(last_pixel(high_y + reach) - tile_y, bounds.y1 - 1);
    g.needs_edges64[i] = max_of(high_x - low_x, high_y - low_y) > kMaxExtent ? 1 : 0;
    visible[i] = ((g.x0[i] <= g.x1[i]) & (g.y0[i] <= g.y1[i])) ? 1 : 0;
  }
  g.mask = nonzero_mask(visible) & low_bits_mask(g.count);
}

/// Sets up edges and bounds of g.count triangles from g.x and g.y. Coordinates are relative to the tile:
/// pixel (0, 0) is its top left. Bits of g.mask are set for triangles with a pixel in `rect`.
/// @param reach  bounds include pixels within this distance from the triangle per axis (samples), 1/256 pixel
inline HWY_NOINLINE void set_up_edges(TriangleGroup& g, int tile_x, int tile_y, const PixelRect& rect,
                                      std::int32_t reach = 0) {
  set_up_areas(g);
  set_up_edge_functions(g, tile_x, tile_y);
  set_up_bounds(g, tile_x, tile_y, rect, reach);
}

/// value * 2^kFraction modulo 2^64, rounded to nearest. Integer and fractional part are converted separately
/// through the bits of a double, which vectorizes. Only the lowest 64 - kFraction bits of the integer part
/// matter.
template <int kFraction>
HWY_INLINE std::uint64_t fixed_modulo(double value) {
  constexpr double kPeriod = kFraction == 32 ? 0x1p32 : 0x1p34;
  constexpr double kScale = kFraction == 32 ? 0x1p32 : 0x1p30;
  constexpr double kBias = 0x1.8p52;
  const double periods = (value * (1 / kPeriod) + kBias) - kBias;  // rounded to the nearest integer
  const double rest = value - periods * kPeriod;                   // exact: |rest| <= kPeriod / 2
  const double biased_integer = rest + kBias;
  const double integer = biased_integer - kBias;
  const double biased_fraction = (rest - integer) * kScale + kBias;  // the difference is exact
  std::uint64_t integer_bits, fraction_bits;
  std::memcpy(&integer_bits, &biased_integer, sizeof integer_bits);
  std::memcpy(&fraction_bits, &biased_fraction, sizeof fraction_bits);
  constexpr std::uint64_t kBiasBits = 0x4338000000000000u;
  return ((integer_bits - kBiasBits) << kFraction) + (fraction_bits - kBiasBits);
}

/// Representation of depth word 0 in a plane, including the biases.
template <int kFraction>
inline constexpr std::uint64_t kPlaneZero =
    kFraction == kUnorm32Fraction
        ? (std::uint64_t{kUnorm32RangeBias} << kUnorm32Fraction) + kUnorm32RoundingBias
        : std::uint64_t{kUnormRoundingBias};

/// Value of a unorm plane at a sample of the tile's first pixel. Steps from the anchor's pixel are exact.
/// @param dx, dy  the plane's steps in fixed point
/// @param sample  offset of the sample from the pixel's centre
template <int kFraction>
HWY_INLINE std::uint64_t fixed_base(const TriangleGroup& g, int i, std::uint64_t dx, std::uint64_t dy,
                                    SamplePosition sample, int tile_x, int tile_y) {
  // The sample is handled as the centre of the pixel, and the anchor is moved by the negative offset.
  const std::int32_t x = g.anchor_x[i] - sample.x, y = g.anchor_y[i] - sample.y;
  const double to_center = g.depth_dx[i] * ((kHalfPixel - (x & 255)) * (1.0 / 256)) +
                           g.depth_dy[i] * ((kHalfPixel - (y & 255)) * (1.0 / 256));
  return kPlaneZero<kFraction> + (std::uint64_t{g.anchor_z[i]} << kFraction) +
         fixed_modulo<kFraction>(to_center) +
         dx * static_cast<std::uint64_t>(std::int64_t{tile_x - (x >> 8)}) +
         dy * static_cast<std::uint64_t>(std::int64_t{tile_y - (y >> 8)});
}

/// Sets up the unorm depth planes of a group in fixed point.
template <int kFraction>
HWY_INLINE void set_up_fixed_depth(TriangleGroup& g, int tile_x, int tile_y) {
  for (int i = 0; i < kGroupSize; ++i) {
    const std::uint64_t dx = fixed_modulo<kFraction>(g.depth_dx[i]);
    const std::uint64_t dy = fixed_modulo<kFraction>(g.depth_dy[i]);
    g.fixed_dx[i] = dx;
    g.fixed_dy[i] = dy;
    g.fixed_base[i] = fixed_base<kFraction>(g, i, dx, dy, {0, 0}, tile_x, tile_y);
  }
}

/// A unorm depth plane in fixed point: steps per pixel, and the value at a sample of the tile's first pixel.
struct FixedPlane {
  std::uint64_t dx, dy, base;
};
/// Unorm depth plane of triangle i in exact integers, for needles: their gradients are steep and the terms
/// cancel. Otherwise as fixed_base().
template <int kFraction>
FixedPlane exact_depth(const TriangleGroup& g, int i, SamplePosition sample, int tile_x, int tile_y) {
  using Wide = __int128;
  const auto area = static_cast<std::int64_t>(g.area[i]);
  // Gradients in depth words per 1/256 pixel, times the area: below 2^57.
  std::int64_t dx_area = 0, dy_area = 0;
  for (int k = 0; k < 3; ++k) {
    const std::int64_t dz = std::int64_t{g.z[k][i]} - g.anchor_z[i];
    dx_area += g.a[k][i] * dz;
    dy_area += g.b[k][i] * dz;
  }
  // numerator / area in fixed point, rounded to nearest, modulo 2^64.
  const auto fixed = [area](Wide numerator) {
    const Wide scaled = numerator * (Wide{1} << kFraction);
    const Wide half = area / 2;
    return static_cast<std::uint64_t>((scaled + (scaled < 0 ? -half : half)) / area);
  };
  const std::int32_t x = g.anchor_x[i] - sample.x, y = g.anchor_y[i] - sample.y;
  const std::uint64_t dx = fixed(Wide{dx_area} * kSubpixelScale);
  const std::uint64_t dy = fixed(Wide{dy_area} * kSubpixelScale);
  const std::uint64_t to_center =
      fixed(Wide{dx_area} * (kHalfPixel - (x & 255)) + Wide{dy_area} * (kHalfPixel - (y & 255)));
  return {dx, dy,
          kPlaneZero<kFraction> + (std::uint64_t{g.anchor_z[i]} << kFraction) + to_center +
              dx * static_cast<std::uint64_t>(std::int64_t{tile_x - (x >> 8)}) +
              dy * static_cast<std::uint64_t>(std::int64_t{tile_y - (y >> 8)})};
}

/// Computes error bounds of the unorm planes in double, and returns the mask of the triangles whose bound
/// exceeds the rounding bias. Two errors add up at a pixel:
/// - A gradient has four roundings, 2^-51 of its terms, and is multiplied by the number of pixels from the
///   anchor, whose pixel's centre is less than two away.
/// - Fixed point rounds by half a unit in the last place per pixel.
///
/// @param error  bounds in units of the last place of fixed point, times the area
template <int kFraction>
HWY_INLINE std::uint32_t bound_errors(const TriangleGroup& g, const double (&dz)[3][kGroupSize],
                                      double (&error)[kGroupSize]) {
  constexpr double kGradientError = kFraction == 32 ? 0x1p-19 : 0x1p-21;
  constexpr double kStepError = 1.0 / (2 * kSubpixelScale);
  constexpr double kRoundingBias = kFraction == 32 ? kUnormRoundingBias : kUnorm32RoundingBias;
  alignas(64) std::int32_t exceeds_bias[kGroupSize];
  for (int i = 0; i < kGroupSize; ++i) {
    double terms = 0, extents = 0;
    for (int k = 0; k < 3; ++k) {
      const double steps =
          __builtin_fabs(static_cast<double>(g.a[k][i])) + __builtin_fabs(static_cast<double>(g.b[k][i]));
      terms += steps * __builtin_fabs(dz[k][i]);
      extents += steps;
    }
    // In 1/256 pixel. The three edges cover width and height twice, forth and back.
    const double reach = 0.5 * extents + 4 * kSubpixelScale;
    error[i] = (terms * kGradientError + g.area[i] * kStepError) * reach;
    exceeds_bias[i] = error[i] > kRoundingBias * g.area[i] ? 1 : 0;
  }
  return nonzero_mask(exceeds_bias);
}

/// Sets up the unorm depth planes of a group: in double if the error is below 2^-8 of a depth word, else
/// exactly.
template <int kFraction>
HWY_INLINE void set_up_unorm_depth(TriangleGroup& g, const double (&dz)[3][kGroupSize], int tile_x,
                                   int tile_y) {
  set_up_fixed_depth<kFraction>(g, tile_x, tile_y);
  alignas(64) double error[kGroupSize];
  g.extra_bias_mask = bound_errors<kFraction>(g, dz, error) & g.mask;
  constexpr double kTolerance = kFraction == 32 ? 0x1p24 : 0x1p22;  // 2^-8 of a depth word
  g.exact_depth_mask = 0;
  for (std::uint32_t left = g.extra_bias_mask; left != 0; left &= left - 1) {
    const int i = std::countr_zero(left);
    if (error[i] <= kTolerance * g.area[i]) {
      g.extra_bias[i] = static_cast<std::uint64_t>(error[i] / g.area[i]);
      g.fixed_base[i] += g.extra_bias[i];
      continue;
    }
    g.exact_depth_mask |= 1u << i;
    g.extra_bias[i] = std::uint64_t{1} << 17;  // bounds the rounding of the steps in the largest triangle
    const FixedPlane exact = exact_depth<kFraction>(g, i, {0, 0}, tile_x, tile_y);
    g.fixed_dx[i] = exact.dx;
    g.fixed_dy[i] = exact.dy;
    g.fixed_base[i] = exact.base + g.extra_bias[i];
  }
}

/// Selects the anchor vertices of depth planes.
HWY_INLINE void set_up_anchors(TriangleGroup& g) {
  for (int i = 0; i < kGroupSize; ++i) {
    const bool second = g.y[1][i] < g.y[0][i] || (g.y[1][i] == g.y[0][i] && g.x[1][i] < g.x[0][i]);
    const std::int32_t x = second ? g.x[1][i] : g.x[0][i], y = second ? g.y[1][i] : g.y[0][i];
    const std::uint32_t z = second ? g.z[1][i] : g.z[0][i];
    const bool third = g.y[2][i] < y || (g.y[2][i] == y && g.x[2][i] < x);
    g.anchor_x[i] = third ? g.x[2][i] : x;
    g.anchor_y[i] = third ? g.y[2][i] : y;
    g.anchor_z[i] = third ? g.z[2][i] : z;
  }
}

/// A depth word as a double, exactly.
template <bool kFloat>
HWY_INLINE double depth_number(std::uint32_t word) {
  if constexpr (kFloat) {
    float f;
    std::memcpy(&f, &word, sizeof f);
    return f;
  } else {
    // Through a signed integer, whose conversion vectorizes.
    return static_cast<double>(static_cast<std::int32_t>(word ^ 0x80000000u)) + 2147483648.0;
  }
}

/// Depth gradients per pixel, in depth words (unorm) or in depth (float32). `dz` gets the vertices'
/// differences from the anchor. One of them is 0, so the sums below do not depend on the order of the
/// vertices.
template <bool kFloat>
HWY_INLINE void set_up_gradients(TriangleGroup& g, double (&dz)[3][kGroupSize]) {
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < kGroupSize; ++i)
      dz[k][i] = depth_number<kFloat>(g.z[k][i]) - depth_number<kFloat>(g.anchor_z[i]);
  for (int i = 0; i < kGroupSize; ++i) {
    const double scale = 256.0 / g.area[i];
    g.depth_dx[i] = (g.a[0][i] * dz[0][i] + g.a[1][i] * dz[1][i] + g.a[2][i] * dz[2][i]) * scale;
    g.depth_dy[i] = (g.b[0][i] * dz[0][i] + g.b[1][i] * dz[1][i] + g.b[2][i] * dz[2][i]) * scale;
  }
}

inline HWY_NOINLINE void set_up_depth(TriangleGroup& g, DepthFormat kind, int tile_x, int tile_y) {
  alignas(64) double dz[3][kGroupSize];
  set_up_anchors(g);
  if (kind == DepthFormat::float32) return set_up_gradients<true>(g, dz);
  set_up_gradients<false>(g, dz);
  if (kind == DepthFormat::unorm32) set_up_unorm_depth<kUnorm32Fraction>(g, dz, tile_x, tile_y);
  else set_up_unorm_depth<kUnormFraction>(g, dz, tile_x, tile_y);
}

HWY_INLINE void set_up_sample_edges(const TriangleGroup& g, SampleGroup& to, int samples) {
  const SamplePosition* const positions = sample_positions(samples);
  for (int k = 0; k < 3; ++k) {
    alignas(64) std::int32_t highest[kGroupSize], at_center[kGroupSize];
    for (int i = 0; i < kGroupSize; ++i) {
      const std::int32_t a = g.a[k][i], b = g.b[k][i];
      const std::int32_t bias = a > 0 || (a == 0 && b > 0) ? 0 : -1;
      at_center[i] = static_cast<std::int32_t>(g.edge_fraction[k][i]) + bias;
      highest[i] = std::numeric_limits<std::int32_t>::min();
    }
    for (int s = 0; s < samples; ++s)
      for (int i = 0; i < kGroupSize; ++i) {
        const std::int32_t moved =
            (at_center[i] + g.a[k][i] * positions[s].x + g.b[k][i] * positions[s].y) >> kSubpixelBits;
        to.edge_delta[s][k][i] = moved;
        highest[i] = std::max(highest[i], moved);
      }
    for (int s = 0; s < samples; ++s)
      for (int i = 0; i < kGroupSize; ++i) to.edge_delta[s][k][i] -= highest[i];
    for (int i = 0; i < kGroupSize; ++i)
      to.max_edge[k][i] = static_cast<std::int32_t>(static_cast<std::uint32_t>(g.e[k][i]) +
                                                    static_cast<std::uint32_t>(highest[i]));
  }
}

template <int kFraction>
HWY_INLINE void set_up_sample_depth(const TriangleGroup& g, SampleGroup& to, int samples, int tile_x,
                                    int tile_y) {
  const SamplePosition* const positions = sample_positions(samples);
  for (int s = 0; s < samples; ++s) {
    const SamplePosition at = positions[s];
    for (int i = 0; i < kGroupSize; ++i)
      to.fixed_base[s][i] = fixed_base<kFraction>(g, i, g.fixed_dx[i], g.fixed_dy[i], at, tile_x, tile_y);
    for (std::uint32_t left = g.extra_bias_mask; left != 0; left &= left - 1) {
      const int i = std::countr_zero(left);
      if ((g.exact_depth_mask >> i & 1) != 0)
        to.fixed_base[s][i] = exact_depth<kFraction>(g, i, at, tile_x, tile_y).base;
      to.fixed_base[s][i] += g.extra_bias[i];
    }
  }
}

/// Sets up edges and unorm depth of a group at the samples of its pixels. For triangles with 32-bit edges.
/// @pre set_up_edges() and, for unorm depth, set_up_depth() have run
inline HWY_NOINLINE void set_up_samples(const TriangleGroup& g, SampleGroup& to, int samples,
                                        DepthFormat kind, int tile_x, int tile_y) {
  set_up_sample_edges(g, to, samples);
  if (kind == DepthFormat::none || kind == DepthFormat::float32) return;
  if (kind == DepthFormat::unorm32) set_up_sample_depth<kUnorm32Fraction>(g, to, samples, tile_x, tile_y);
  else set_up_sample_depth<kUnormFraction>(g, to, samples, tile_x, tile_y);
}

/// Perspective weights of the vertices as linear functions of the edges: weight_k = scale_k E_k + shift_k is
/// the barycentric coordinate times the vertex's 1/w, relative to the triangle's largest 1/w.
inline HWY_NOINLINE void set_up_weights(TriangleGroup& g) {
  for (int i = 0; i < kGroupSize; ++i) {
    const float r0 = g.rw[0][i], r1 = g.rw[1][i], r2 = g.rw[2][i];
    const float largest_01 = r0 > r1 ? r0 : r1;
    const float largest = largest_01 > r2 ? largest_01 : r2;
    const bool affine = ((r0 == r1) & (r1 == r2)) | !((largest > 0x1p-120f) & (largest < 0x1p120f));
    g.affine[i] = affine ? 1 : 0;
    const float divisor = affine ? 1.0f : largest;
    const float inverse = static_cast<float>(1.0 / g.area[i]);
    for (int k = 0; k < 3; ++k) {
      const float ratio = (affine ? 1.0f : g.rw[k][i]) / divisor;
      const float relative = ratio > kMinWeight ? ratio : kMinWeight;
      g.unit_scale[k][i] = inverse * relative;
      g.scale[k][i] = 256.0f * (inverse * relative);
      g.shift[k][i] = g.edge_fraction[k][i] * (inverse * relative);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera::detail
HWY_AFTER_NAMESPACE();

#endif
