// Depth of a triangle's pixels, as keys that compare as signed integers (framebuffer/format.h).
//
// Unorm: a plane in 64-bit fixed point, modulo 2^64: sums are exact in any order, so the depth of a pixel does not depend on
// tiles or blocks, and a gradient too steep for 64 bits comes right again inside the triangle. float32: one fused
// multiply-add for each direction from the first vertex, kept within the vertices' range.
#if defined(TESSERA_RASTER_DEPTH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TESSERA_RASTER_DEPTH_INL_H_
#undef TESSERA_RASTER_DEPTH_INL_H_
#else
#define TESSERA_RASTER_DEPTH_INL_H_
#endif

#include <cmath>
#include <cstring>

#include "raster/lanes-inl.h"
#include "raster/triangle_setup.h"

HWY_BEFORE_NAMESPACE();
namespace tessera {
namespace HWY_NAMESPACE {

using Uint64Tag = hn::Repartition<std::uint64_t, FloatTag>;
using Int64Tag = hn::RebindToSigned<Uint64Tag>;
inline constexpr Uint64Tag kUint64{};
inline constexpr Int64Tag kInt64{};

/// `value` * 2^fraction_bits modulo 2^64, to the nearest.
HWY_INLINE std::uint64_t fixed_modulo(double value, int fraction_bits) {
  // Only the lowest 64 - fraction_bits bits of the whole part count.
  const double period = fraction_bits == 32 ? 0x1p32 : 0x1p34;
  const double turns = (value / period + 0x1.8p52) - 0x1.8p52;  // to the nearest whole number
  const double rest = value - turns * period;                   // exact: |rest| <= period / 2
  double scaled = rest * (fraction_bits == 32 ? 0x1p32 : 0x1p30);
  scaled = scaled < 0x1.fffffffffffffp62 ? scaled : 0x1.fffffffffffffp62;  // +2^63 itself does not convert
  return static_cast<std::uint64_t>(static_cast<std::int64_t>(scaled < 0 ? scaled - 0.5 : scaled + 0.5));
}

/// 16 and 24 bits: 32.32 fixed point of the vertices' depth words. Those are at least 128 away from 0 and from 2^32 (the half
/// that rounds the level), so rounding never wraps around. The key is the word's top bits.
struct UnormDepth {
  std::uint64_t base, dx, dy;
  int shift;
  alignas(64) std::uint64_t offset[16];  // of a block's pixels

  static constexpr int kFraction = 32;
  HWY_INLINE void set_up(const TriangleGroup& g, int i, int tile_x, int tile_y, DepthKind kind) {
    shift = kind == DepthKind::unorm16 ? 16 : 8;
    plane(g, i, tile_x, tile_y, 0);
  }
  HWY_INLINE void plane(const TriangleGroup& g, int i, int tile_x, int tile_y, std::uint64_t lift, int fraction = kFraction) {
    const double gx = g.depth_dx[i], gy = g.depth_dy[i];
    dx = fixed_modulo(gx, fraction);
    dy = fixed_modulo(gy, fraction);
    const std::int32_t x = g.x[0][i], y = g.y[0][i];
    // From the first vertex to the centre of its pixel, then by whole pixels to the tile's first.
    const double to_center = gx * ((kHalfPixel - (x & 255)) * (1.0 / 256)) + gy * ((kHalfPixel - (y & 255)) * (1.0 / 256));
    base = ((std::uint64_t{g.z[0][i]} + lift) << fraction) + fixed_modulo(to_center, fraction) +
           dx * static_cast<std::uint64_t>(std::int64_t{tile_x} - (x >> 8)) + dy * static_cast<std::uint64_t>(std::int64_t{tile_y} - (y >> 8));
  }
  HWY_INLINE void prepare_blocks() {
    for (int p = 0; p < 16; ++p) offset[p] = dx * static_cast<std::uint64_t>(p & 3) + dy * static_cast<std::uint64_t>(p >> 2);
  }
  HWY_INLINE std::uint64_t at(int x, int y) const {
    return base + dx * static_cast<std::uint64_t>(std::int64_t{x}) + dy * static_cast<std::uint64_t>(std::int64_t{y});
  }
  HWY_INLINE std::int32_t key(int x, int y) const { return static_cast<std::int32_t>(static_cast<std::uint32_t>(at(x, y) >> 32) >> shift); }
  HWY_INLINE Int keys(int bx, int by, int chunk) const {
    const std::uint64_t block = at(bx, by);
#if HWY_TARGET == HWY_SCALAR
    return Int(static_cast<std::int32_t>(static_cast<std::uint32_t>((block + offset[chunk]) >> 32) >> shift));
#else
    const auto start = hn::Set(kUint64, block);
    const auto low = hn::Add(start, hn::Load(kUint64, offset + chunk * kLanes));
    const auto high = hn::Add(start, hn::Load(kUint64, offset + chunk * kLanes + kLanes / 2));
    const Uint words = hn::ConcatOdd(kUint, hn::BitCast(kUint, high), hn::BitCast(kUint, low));
    return hn::BitCast(kInt, hn::ShiftRightSame(words, shift));
#endif
  }
};

/// 32 bits use the whole word, so there is no margin at the ends: 34.30 fixed point, lifted by 2^32 and cut to range.
struct Unorm32Depth : UnormDepth {
  static constexpr int kFraction = 30;
  static constexpr std::int64_t kLift = std::int64_t{1} << 32, kTop = kLift + 0xffffffff;
  HWY_INLINE void set_up(const TriangleGroup& g, int i, int tile_x, int tile_y, DepthKind) {
    shift = 0;
    plane(g, i, tile_x, tile_y, static_cast<std::uint64_t>(kLift), kFraction);
  }
  static HWY_INLINE std::int32_t key_of(std::uint64_t value) {
    const std::int64_t lifted = static_cast<std::int64_t>(value >> kFraction);
    const std::int64_t cut = lifted < kLift ? kLift : lifted > kTop ? kTop : lifted;
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(cut) ^ 0x80000000u);
  }
  HWY_INLINE std::int32_t key(int x, int y) const { return key_of(at(x, y)); }
  HWY_INLINE Int keys(int bx, int by, int chunk) const {
    const std::uint64_t block = at(bx, by);
    alignas(64) std::int32_t key[kLanes];
    for (int l = 0; l < kLanes; ++l) key[l] = key_of(block + offset[chunk * kLanes + l]);
    return hn::Load(kInt, key);
  }
};

struct Float32Depth {
  float z0, dx, dy, first_x, first_y, low, high;  // first_x, y: from the first vertex to the tile's first pixel centre
  HWY_INLINE void set_up(const TriangleGroup& g, int i, int tile_x, int tile_y, DepthKind) {
    float z[3];
    for (int k = 0; k < 3; ++k) std::memcpy(&z[k], &g.z[k][i], sizeof z[k]);
    z0 = z[0];
    low = z[0] < z[1] ? (z[0] < z[2] ? z[0] : z[2]) : (z[1] < z[2] ? z[1] : z[2]);
    high = z[0] > z[1] ? (z[0] > z[2] ? z[0] : z[2]) : (z[1] > z[2] ? z[1] : z[2]);
    dx = static_cast<float>(g.depth_dx[i]);
    dy = static_cast<float>(g.depth_dy[i]);
    first_x = static_cast<float>((tile_x * kSubpixelScale + kHalfPixel - g.x[0][i]) * (1.0 / 256));  // exact: 24 bits
    first_y = static_cast<float>((tile_y * kSubpixelScale + kHalfPixel - g.y[0][i]) * (1.0 / 256));
  }
  HWY_INLINE void prepare_blocks() {}
  HWY_INLINE std::int32_t key(int x, int y) const {
    const float z = std::fma(dx, first_x + static_cast<float>(x), std::fma(dy, first_y + static_cast<float>(y), z0));
    const float low_cut = z > low ? z : low, cut = (low_cut < high ? low_cut : high) + 0.0f;  // + 0: no negative zero
    std::int32_t bits;
    std::memcpy(&bits, &cut, sizeof bits);
    return bits;
  }
  HWY_INLINE Int keys(int bx, int by, int chunk) const {
    const Float x = hn::Add(splat(first_x + static_cast<float>(bx)), hn::ConvertTo(kFloat, block_columns(chunk)));
    const Float y = hn::Add(splat(first_y + static_cast<float>(by)), hn::ConvertTo(kFloat, block_rows(chunk)));
    const Float z = mul_add(splat(dx), x, mul_add(splat(dy), y, splat(z0)));
    const Float low_cut = hn::IfThenElse(hn::Gt(z, splat(low)), z, splat(low));
    const Float cut = hn::Add(hn::IfThenElse(hn::Lt(low_cut, splat(high)), low_cut, splat(high)), hn::Zero(kFloat));
    return hn::BitCast(kInt, cut);
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace tessera
HWY_AFTER_NAMESPACE();

#endif
