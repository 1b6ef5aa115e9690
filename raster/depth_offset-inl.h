// Depth with polygon offset: factor times the polygon's slope, plus units times the smallest difference of
// the format; the result is clamped to 0..1 [GL 2.1, 3.5.5; float32: Direct3D 11]. Used by draws with an
// offset only.
#if defined(TESSERA_RASTER_DEPTH_OFFSET_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TESSERA_RASTER_DEPTH_OFFSET_INL_H_
#undef TESSERA_RASTER_DEPTH_OFFSET_INL_H_
#else
#define TESSERA_RASTER_DEPTH_OFFSET_INL_H_
#endif

#include <algorithm>
#include <cmath>

#include "raster/depth-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tessera::detail {
namespace HWY_NAMESPACE {

/// max(|dz/dx|, |dz/dy|) per pixel, in depth words (unorm) or in depth (float32).
HWY_INLINE double slope_of(const TriangleGroup& g, int i) {
  return std::max(std::abs(g.depth_dx[i]), std::abs(g.depth_dy[i]));
}

/// All unorm formats. The offset is added to the plane of draws without an offset, so that one unit separates
/// two draws of the same triangle by exactly one level.
struct OffsetUnormDepth : UnormDepth {
  int fraction_bits = kUnormFraction;
  std::int64_t range_bias = 0;
  std::int64_t polygon_offset = 0;  // depth words
  std::uint32_t flip = 0;
  HWY_INLINE void set_up(const TriangleGroup& g, int i, int, int, DepthFormat kind) {
    shift = 32 - depth_bits(kind);
    if (kind == DepthFormat::unorm32) {
      fraction_bits = kUnorm32Fraction;
      range_bias = kUnorm32RangeBias;
      flip = 0x80000000u;
    }
    base = g.fixed_base[i];
    dx = g.fixed_dx[i];
    dy = g.fixed_dy[i];
  }
  HWY_INLINE void set_polygon_offset(const TriangleGroup& g, int i, float factor, float units) {
    set_polygon_offset_value(double{factor} * slope_of(g, i) + std::ldexp(double{units}, shift));
  }
  HWY_INLINE void set_polygon_offset_value(double words) {
    constexpr double kRange = 0x1p32;  // offsets beyond the whole range of depth words have no further effect
    polygon_offset = static_cast<std::int64_t>(std::floor(std::clamp(words, -kRange, kRange) + 0.5));
  }
  HWY_INLINE std::int32_t key_of(std::uint64_t value) const {
    const std::int64_t word = static_cast<std::int64_t>(value >> fraction_bits) - range_bias + polygon_offset;
    const std::int64_t at_least_zero = word < 0 ? 0 : word;
    const std::int64_t clamped = at_least_zero > 0xffffffff ? 0xffffffff : at_least_zero;
    return static_cast<std::int32_t>((static_cast<std::uint32_t>(clamped) >> shift) ^ flip);
  }
  struct Block {
    std::uint64_t start;
  };
  HWY_INLINE Block block(int bx, int by) const { return {at(bx, by)}; }
  HWY_INLINE Int keys(const Block& block, int chunk) const {
    alignas(64) std::int32_t key[kLanes];
    for (int l = 0; l < kLanes; ++l) key[l] = key_of(block.start + offset[chunk * kLanes + l]);
    return hn::Load(kInt, key);
  }
};

struct OffsetFloat32Depth : Float32Depth {
  float polygon_offset = 0;
  HWY_INLINE void set_polygon_offset(const TriangleGroup& g, int i, float factor, float units) {
    // Exponent of the largest depth, at least that of the smallest normal float.
    const int exponent = std::max(high > 0 ? std::ilogb(high) : -126, -126);
    set_polygon_offset_value(double{factor} * slope_of(g, i) + std::ldexp(double{units}, exponent - 23));
  }
  HWY_INLINE void set_polygon_offset_value(double depth) { polygon_offset = static_cast<float>(depth); }
  HWY_INLINE Int keys(const Block& block, int chunk) const {
    const Float z = hn::Add(hn::BitCast(kFloat, Float32Depth::keys(block, chunk)), splat(polygon_offset));
    return hn::BitCast(kInt, lesser_of(greater_of(z, hn::Zero(kFloat)), splat(1.0f)));
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace tessera::detail
HWY_AFTER_NAMESPACE();

#endif
