// Pixels of small triangles with interpolated colours: the pixels of a whole group are evaluated in lanes,
// then tested and stored one by one, in order.
#if defined(TESSERA_SHADING_SMALL_TRIANGLE_PIXELS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TESSERA_SHADING_SMALL_TRIANGLE_PIXELS_INL_H_
#undef TESSERA_SHADING_SMALL_TRIANGLE_PIXELS_INL_H_
#else
#define TESSERA_SHADING_SMALL_TRIANGLE_PIXELS_INL_H_
#endif

#include <algorithm>
#include <bit>
#include <type_traits>

#include "raster/depth-inl.h"
#include "raster/lanes-inl.h"
#include "shading/color_eval-inl.h"
#include "shading/pick_by_triangle-inl.h"
#include "shading/tile_context-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tessera::detail {
namespace HWY_NAMESPACE {

/// Pixels of a group's small triangles in drawing order, and their colours.
struct SmallTrianglePixels {
  static constexpr int kCapacity = kGroupSize * kBlockPixels;
  int count = 0;
  alignas(64) std::int32_t place[kCapacity + kLanes];   // triangle << 16 | y << 8 | x, tile-relative
  alignas(64) std::int32_t index[kCapacity + kLanes];   // the pixel in the tile
  alignas(64) std::int32_t key[kCapacity + kLanes];     // depth key, if kHasKeys
  alignas(64) std::int32_t packed[kCapacity + kLanes];  // packed colour
  std::uint32_t triangles = 0;                          // triangles with pixels, one bit each

  static_assert(kMaxTileSize <= 256);
  static HWY_INLINE Int x_of(Int at) { return hn::And(at, splat(255)); }
  static HWY_INLINE Int y_of(Int at) { return hn::And(hn::ShiftRight<8>(at), splat(255)); }
  HWY_INLINE int triangle(int p) const { return place[p] >> 16; }

  /// Adds the pixels of triangle i.
  /// @param hits  4 rows of 4 bits from (x0, y0)
  HWY_INLINE void add(const TriangleGroup& g, int i, std::uint32_t hits) {
    const std::int32_t first = i << 16 | g.y0[i] << 8 | g.x0[i];
    triangles |= 1u << i;
#if HWY_TARGET == HWY_AVX3
    const Int at = hn::Add(splat(first), hn::Or(block_columns(0), hn::ShiftLeft<8>(block_rows(0))));
    hn::StoreU(hn::Compress(at, mask_from_bits(hits)), kInt, place + count);
    count += std::popcount(hits);
#else
    for (; hits != 0; hits &= hits - 1) {
      const int p = std::countr_zero(hits);
      place[count++] = first + ((p >> 2) << 8) + (p & 3);
    }
#endif
  }
  /// Evaluates indices and colours, bit-identical to barycentric_from_edges() and GouraudColorEval.
  /// @pre set_up_weights() has run for the group
  HWY_INLINE void set_up(const TileContext& context, const TileDraw& draw) {
    const TriangleGroup& g = context.memory.group;
    SmallTriangleColorEval colors;
    colors.set_up(context, draw, triangles);
    hn::StoreU(hn::Zero(kInt), kInt, place + count);
    for (int first = 0; first < count; first += kLanes) {
      const Int at = hn::Load(kInt, place + first);
      const Int x = x_of(at), y = y_of(at);
      const PickByTriangle pick(hn::ShiftRight<16>(at));
      hn::StoreU(context.pixel_indices(x, y), kInt, index + first);
      Float w[3];
      for (int k = 0; k < 3; ++k) {
        const Int edge = hn::Add(pick(g.e[k]), hn::Add(hn::Mul(pick(g.a[k]), x), hn::Mul(pick(g.b[k]), y)));
        w[k] = mul_add(hn::ConvertTo(kFloat, edge), pick(g.scale[k]), pick(g.shift[k]));
      }
      const auto affine = hn::RebindMask(kFloat, hn::Ne(pick(g.affine), hn::Zero(kInt)));
      if (!hn::AllTrue(kFloat, affine)) {
        const Float inverse =
            hn::IfThenElse(affine, splat(1.0f), hn::Div(splat(1.0f), hn::Add(hn::Add(w[0], w[1]), w[2])));
        w[1] = hn::Mul(w[1], inverse);
        w[2] = hn::Mul(w[2], inverse);
      }
      hn::Store(colors.packed(pick, w[1], w[2]), kInt, packed + first);
    }
  }
  /// Whether depth keys are computed in lanes, which takes products of 64 bits.
  template <class Depth>
  static constexpr bool kHasKeys = (HWY_TARGET == HWY_AVX3) && std::is_same_v<Depth, UnormDepth>;
  /// Computes the depth keys, bit-identical to UnormDepth::key(). @pre kHasKeys, and set_up() has run
  HWY_INLINE void set_up_keys([[maybe_unused]] const TriangleGroup& g, [[maybe_unused]] DepthFormat kind) {
#if HWY_TARGET == HWY_AVX3
    const int shift = kind == DepthFormat::unorm16 ? 16 : 8;
    for (int first = 0; first < count; first += kLanes) {
      const Int at = hn::Load(kInt, place + first);
      const auto keys_of = [&](auto half_of) HWY_ATTR {  // eight pixels
        const auto wide = [&](Int all) HWY_ATTR { return _mm512_cvtepu32_epi64(half_of(all.raw)); };
        const __m512i of_triangle = wide(hn::ShiftRight<16>(at)), x = wide(x_of(at)), y = wide(y_of(at));
        const auto pick = [&](const std::uint64_t* array) HWY_ATTR {
          return _mm512_permutex2var_epi64(_mm512_load_si512(array), of_triangle,
                                           _mm512_load_si512(array + 8));
        };
        return _mm512_add_epi64(pick(g.fixed_base),
                                _mm512_add_epi64(_mm512_mullo_epi64(pick(g.fixed_dx), x),
                                                 _mm512_mullo_epi64(pick(g.fixed_dy), y)));
      };
      const __m512i low = keys_of([](__m512i all) HWY_ATTR { return _mm512_castsi512_si256(all); });
      const __m512i high = keys_of([](__m512i all) HWY_ATTR { return _mm512_extracti64x4_epi64(all, 1); });
      const Uint upper_halves = hn::ConcatOdd(kUint, Uint{high}, Uint{low});
      hn::Store(hn::BitCast(kInt, hn::ShiftRightSame(upper_halves, shift)), kInt, key + first);
    }
#endif
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace tessera::detail
HWY_AFTER_NAMESPACE();

#endif
