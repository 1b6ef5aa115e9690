// Depth keys of a triangle's pixels (framebuffer/format.h: keys compare as signed integers).
// - Unorm: a plane in 64-bit fixed point, modulo 2^64. Sums are exact in any order, so the depth of a pixel
//   does not depend on tiles or blocks, and overflow of steep gradients cancels inside the triangle.
//   Gradients are computed in double, or as exact quotients for needles, where double is not accurate enough.
// - float32: a plane of doubles from the anchor vertex, rounded once and clamped to the vertices' range.
//
// Depth types evaluate the plane of one triangle in a tile:
// - key(): at one pixel.
// - block(), step_right(), keys(): at the pixels of a 4x4 block, one chunk at a time. A Block is the plane's
//   position at the block's first pixel.
// - box(), block(box, i): at the blocks of a box, four per row.
// - sample_origin(), step_to(), block(origin, step): at one sample of the pixels of a block.
#if defined(TESSERA_RASTER_DEPTH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TESSERA_RASTER_DEPTH_INL_H_
#undef TESSERA_RASTER_DEPTH_INL_H_
#else
#define TESSERA_RASTER_DEPTH_INL_H_
#endif

#include <algorithm>
#include <cmath>
#include <cstring>

#include "framebuffer/format.h"
#include "raster/double_lanes-inl.h"
#include "raster/lanes-inl.h"
#include "raster/triangle_setup.h"

HWY_BEFORE_NAMESPACE();
namespace tessera::detail {
namespace HWY_NAMESPACE {

using Uint64Tag = hn::Repartition<std::uint64_t, FloatTag>;
using Int64Tag = hn::RebindToSigned<Uint64Tag>;
inline constexpr Uint64Tag kUint64{};
inline constexpr Int64Tag kInt64{};

// Masks of eight pixels of a block: columns 1 and 3, columns 2 and 3, the second row.
alignas(64) inline constexpr std::uint64_t kOddColumns[8] = {0, ~0ull, 0, ~0ull, 0, ~0ull, 0, ~0ull};
alignas(64) inline constexpr std::uint64_t kRightColumns[8] = {0, 0, ~0ull, ~0ull, 0, 0, ~0ull, ~0ull};
alignas(64) inline constexpr std::uint64_t kSecondRow[8] = {0, 0, 0, 0, ~0ull, ~0ull, ~0ull, ~0ull};

/// unorm16, unorm24: planes of depth words in 32.32 fixed point. Depth words are at least 128 away from 0 and
/// from 2^32 (the added half level), so rounding never wraps around. The key is the top bits of the word.
struct UnormDepth {
  std::uint64_t base;                    // at the tile's first pixel
  std::uint64_t dx, dy;                  // per pixel
  int shift;                             // key = depth word >> shift
  alignas(64) std::uint64_t offset[16];  // from a block's first pixel to each of its pixels

  HWY_INLINE void set_up(const TriangleGroup& g, int i, int, int, DepthFormat kind) {
    shift = kind == DepthFormat::unorm16 ? 16 : 8;
    base = g.fixed_base[i];
    dx = g.fixed_dx[i];
    dy = g.fixed_dy[i];
  }
  /// Computes `offset`, which keys() and box() need.
  HWY_INLINE void prepare_blocks() {
#if HWY_TARGET == HWY_SCALAR
    for (std::uint64_t p = 0; p < 16; ++p) offset[p] = p % 4 * dx + p / 4 * dy;
#else
    // kHalf lanes are one or two whole rows of the block.
    constexpr std::size_t kHalf = hn::MaxLanes(Uint64Tag());
    static_assert(kHalf == 4 || kHalf == 8);
    const auto masked = [](const std::uint64_t(&mask)[8], std::uint64_t step)
                            HWY_ATTR { return hn::And(hn::Load(kUint64, mask), hn::Set(kUint64, step)); };
    const auto in_row = hn::Add(masked(kOddColumns, dx), masked(kRightColumns, dx + dx));
    auto at = kHalf == 8 ? hn::Add(in_row, masked(kSecondRow, dy)) : in_row;
    for (std::size_t p = 0; p < 16; p += kHalf) {
      hn::Store(at, kUint64, offset + p);
      at = hn::Add(at, hn::Set(kUint64, kHalf / 4 * dy));
    }
#endif
  }
  /// Difference of the plane from the tile's first pixel to pixel (x, y); the same for every sample.
  HWY_INLINE std::uint64_t step(int x, int y) const {
    return dx * static_cast<std::uint64_t>(std::int64_t{x}) +
           dy * static_cast<std::uint64_t>(std::int64_t{y});
  }
  HWY_INLINE std::uint64_t at(int x, int y) const { return base + step(x, y); }
  HWY_INLINE std::int32_t key(int x, int y) const {
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(at(x, y) >> 32) >> shift);
  }
  /// Where block evaluation of one sample starts: the fixed-point value of the depth plane at this sample of
  /// the tile's first pixel.
  using SampleOrigin = std::uint64_t;
  static HWY_INLINE SampleOrigin sample_origin(const TriangleGroup&, const SampleGroup& samples, int s, int i,
                                               SamplePosition, int, int) {
    return samples.fixed_base[s][i];
  }
  /// Lower bound of the keys of triangle i's pixels and samples: the smallest of its vertices, less the
  /// plane's rounding.
  static HWY_INLINE std::int32_t nearest_key(const TriangleGroup& g, int i, DepthFormat kind) {
    return static_cast<std::int32_t>(std::min(g.z[0][i], std::min(g.z[1][i], g.z[2][i])) >>
                                     (32 - depth_bits(kind))) -
           1;
  }
  struct Block {
    hn::Vec<Uint64Tag> start;  // the plane at the block's first pixel, in all lanes
  };
  static HWY_INLINE Block block_at(std::uint64_t start) { return {hn::Set(kUint64, start)}; }
  HWY_INLINE Block block(int bx, int by) const { return block_at(at(bx, by)); }
  /// Depth at the first pixels of a box's blocks, arranged like the pixels of a block. @pre prepare_blocks()
  struct Box {
    alignas(64) std::uint64_t start[kLanes];
  };
  HWY_INLINE Box box(int x, int y) const {
    Box box;
    for (std::size_t p = 0; p < kLanes; p += hn::MaxLanes(Uint64Tag()))
      hn::Store(hn::Add(hn::ShiftLeft<2>(hn::Load(kUint64, offset + p)), hn::Set(kUint64, at(x, y))), kUint64,
                box.start + p);
    return box;
  }
  static HWY_INLINE Block block(const Box& box, int i) { return block_at(box.start[i]); }
  HWY_INLINE void step_right(Block& block) const {
    block.start = hn::Add(block.start, hn::Set(kUint64, 4 * dx));
  }
  /// Step from the tile's first pixel to a block; block(origin, step) adds it to the origin of a sample.
  HWY_INLINE Block step_to(int bx, int by) const { return block_at(step(bx, by)); }
  static HWY_INLINE Block block(SampleOrigin origin, const Block& step) {
    return {hn::Add(block_at(origin).start, step.start)};
  }
  HWY_INLINE Int keys(const Block& block, int chunk) const {
#if HWY_TARGET == HWY_SCALAR
    return Int(static_cast<std::int32_t>(
        static_cast<std::uint32_t>((block.start.raw + offset[chunk]) >> 32) >> shift));
#else
    const auto low = hn::Add(block.start, hn::Load(kUint64, offset + chunk * kLanes));
    const auto high = hn::Add(block.start, hn::Load(kUint64, offset + chunk * kLanes + kLanes / 2));
    const Uint words = hn::ConcatOdd(kUint, hn::BitCast(kUint, high), hn::BitCast(kUint, low));
    return hn::BitCast(kInt, hn::Shr(words, hn::Set(kUint, static_cast<std::uint32_t>(shift))));
#endif
  }
};

/// unorm32: 34.30 fixed point, see kUnorm32RangeBias.
struct Unorm32Depth : UnormDepth {
  HWY_INLINE void set_up(const TriangleGroup& g, int i, int, int, DepthFormat) {
    shift = 0;
    base = g.fixed_base[i];
    dx = g.fixed_dx[i];
    dy = g.fixed_dy[i];
  }
  static HWY_INLINE std::int32_t key_of(std::uint64_t value) {
    constexpr std::int64_t kTop = kUnorm32RangeBias + 0xffffffff;
    const std::int64_t biased = static_cast<std::int64_t>(value >> kUnorm32Fraction);
    const std::int64_t at_least_zero = biased < kUnorm32RangeBias ? kUnorm32RangeBias : biased;
    const std::int64_t clamped = at_least_zero > kTop ? kTop : at_least_zero;
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(clamped) ^ 0x80000000u);
  }
  HWY_INLINE std::int32_t key(int x, int y) const { return key_of(at(x, y)); }
  // UnormDepth::nearest_key() does not flip the top bit.
  static std::int32_t nearest_key(const TriangleGroup& g, int i, DepthFormat kind) = delete;
  struct Block {
    std::uint64_t start;
  };
  HWY_INLINE Block block(int bx, int by) const { return {at(bx, by)}; }
  HWY_INLINE void step_right(Block& block) const { block.start += 4 * dx; }
  HWY_INLINE Block step_to(int bx, int by) const { return {step(bx, by)}; }
  static HWY_INLINE Block block(SampleOrigin origin, const Block& step) { return {origin + step.start}; }
  HWY_INLINE Int keys(const Block& block, int chunk) const {
    alignas(64) std::int32_t key[kLanes];
    for (int l = 0; l < kLanes; ++l) key[l] = key_of(block.start + offset[chunk * kLanes + l]);
    return hn::Load(kInt, key);
  }
};

/// float32: a plane of doubles, rounded once. Double, because the terms of x and y can be many times the
/// depth itself if a large triangle is tilted against the rows.
struct Float32Depth {
  double z0;                // depth of the anchor vertex
  double dx, dy;            // per pixel
  double first_x, first_y;  // from the anchor vertex to the centre of the tile's first pixel, pixels
  float low, high;          // range of the vertices' depths
  HWY_INLINE void set_up(const TriangleGroup& g, int i, int tile_x, int tile_y, DepthFormat) {
    float z[3], at_anchor;
    for (int k = 0; k < 3; ++k) std::memcpy(&z[k], &g.z[k][i], sizeof z[k]);
    std::memcpy(&at_anchor, &g.anchor_z[i], sizeof at_anchor);
    z0 = at_anchor;
    const float low_01 = z[0] < z[1] ? z[0] : z[1];
    const float high_01 = z[0] > z[1] ? z[0] : z[1];
    low = low_01 < z[2] ? low_01 : z[2];
    high = high_01 > z[2] ? high_01 : z[2];
    dx = g.depth_dx[i];
    dy = g.depth_dy[i];
    const SampleOrigin first = from_anchor(g, i, {0, 0}, tile_x, tile_y);
    first_x = first.x;
    first_y = first.y;
  }
  HWY_INLINE void prepare_blocks() {}
  /// Where block evaluation of one sample starts: the vector from the anchor vertex to this sample of the
  /// tile's first pixel, in pixels.
  struct SampleOrigin {
    double x, y;
  };
  /// The vector from the anchor vertex of triangle i to a sample of the tile's first pixel. Exact: 24 bits.
  /// @param at  offset of the sample from the pixel's centre; {0, 0} yields the vector to the centre
  static HWY_INLINE SampleOrigin from_anchor(const TriangleGroup& g, int i, SamplePosition at, int tile_x,
                                             int tile_y) {
    return {(tile_x * kSubpixelScale + kHalfPixel - (g.anchor_x[i] - at.x)) * (1.0 / 256),
            (tile_y * kSubpixelScale + kHalfPixel - (g.anchor_y[i] - at.y)) * (1.0 / 256)};
  }
  static HWY_INLINE SampleOrigin sample_origin(const TriangleGroup& g, const SampleGroup&, int, int i,
                                               SamplePosition at, int tile_x, int tile_y) {
    return from_anchor(g, i, at, tile_x, tile_y);
  }
  /// The bits of floats that are not negative compare as the floats do.
  static HWY_INLINE std::int32_t nearest_key(const TriangleGroup& g, int i, DepthFormat) {
    return static_cast<std::int32_t>(std::min(g.z[0][i], std::min(g.z[1][i], g.z[2][i])));
  }
  HWY_INLINE std::int32_t key(int x, int y) const {
    const auto z = static_cast<float>((dx * (first_x + x) + dy * (first_y + y)) + z0);
    const float at_least_low = z > low ? z : low;
    const float clamped = (at_least_low < high ? at_least_low : high) + 0.0f;  // + 0: no negative zero
    std::int32_t bits;
    std::memcpy(&bits, &clamped, sizeof bits);
    return bits;
  }
  struct Block {
    double x, y;  // vector from the anchor vertex to the block's first pixel, pixels
  };
  HWY_INLINE Block block(int bx, int by) const { return {first_x + bx, first_y + by}; }
  struct Box {
    int x, y;
  };
  HWY_INLINE Box box(int x, int y) const { return {x, y}; }
  HWY_INLINE Block block(const Box& box, int i) const {
    return block(box.x + 4 * (i & 3), box.y + 4 * (i >> 2));
  }
  HWY_INLINE void step_right(Block& block) const { block.x += 4; }  // exact: 24 bits
  HWY_INLINE Block step_to(int bx, int by) const {
    return {static_cast<double>(bx), static_cast<double>(by)};
  }
  static HWY_INLINE Block block(SampleOrigin origin, const Block& step) {
    return {origin.x + step.x, origin.y + step.y};
  }
  HWY_INLINE Int keys(const Block& block, int chunk) const {
    const Doubles x = plus(to_doubles(block_columns(chunk)), block.x);
    const Doubles y = plus(to_doubles(block_rows(chunk)), block.y);
    const Float z = to_floats(plus(plus(times(x, dx), times(y, dy)), z0));
    const Float clamped = lesser_of(greater_of(z, splat(low)), splat(high));
    return hn::BitCast(kInt, hn::Add(clamped, hn::Zero(kFloat)));  // + 0: no negative zero
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace tessera::detail
HWY_AFTER_NAMESPACE();

#endif
