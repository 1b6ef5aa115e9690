// Pixels of triangles so small that each has but a few: those of a whole group stand side by side in lanes,
// and are stored one after the other.
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
#include "shading/tile_context-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tessera::detail {
namespace HWY_NAMESPACE {

/// One element for each of kGroupSize triangles, picked by their numbers in the lanes.
struct PickByTriangle {
#if HWY_TARGET == HWY_SCALAR
  Int triangle;
  HWY_INLINE explicit PickByTriangle(Int of) : triangle(of) {}
  HWY_INLINE Int operator()(const std::int32_t* array) const { return Int(array[triangle.raw]); }
  HWY_INLINE Float operator()(const float* array) const { return Float(array[triangle.raw]); }
#else
  using Indices = decltype(hn::IndicesFromVec(kInt, Int()));
  Indices place;
  hn::Mask<IntTag> is_second;  // with 8 lanes half of the array is another vector
  HWY_INLINE explicit PickByTriangle(Int triangle)
      : place(hn::IndicesFromVec(kInt, hn::And(triangle, splat(kLanes - 1)))),
        is_second(hn::Gt(triangle, splat(kLanes - 1))) {}
  HWY_INLINE Int operator()(const std::int32_t* array) const {
    const Int first = hn::TableLookupLanes(hn::Load(kInt, array), place);
    return kLanes == kGroupSize
               ? first
               : hn::IfThenElse(is_second,
                                hn::TableLookupLanes(hn::Load(kInt, array + kGroupSize - kLanes), place),
                                first);
  }
  HWY_INLINE Float operator()(const float* array) const {
    return hn::BitCast(kFloat, (*this)(reinterpret_cast<const std::int32_t*>(array)));
  }
#endif
};

/// Colours at the vertices of a group's triangles, as arrays.
struct SmallTriangleColorEval {
  alignas(64) float component[3][3][kGroupSize];  // red, green and blue of each vertex
  int r_shift, g_shift;

  /// @param triangles  those that have pixels, a bit each; what others get means nothing
  HWY_INLINE void set_up(const TileContext& context, const TileDraw& draw, std::uint32_t triangles) {
    r_shift = context.frame.layout.r_shift();
    g_shift = context.frame.layout.g_shift();
    const bool has_faces = draw.color_attribute[0] != draw.color_attribute[1];
    for (int first = 0; first < kGroupSize; first += 4) {
      if ((triangles >> first & 15) == 0) continue;
      int triangle[4], attribute[4];
      for (int t = 0; t < 4; ++t) {
        triangle[t] = std::min(first + t, context.memory.group.count - 1);
        attribute[t] = draw.color_attribute[has_faces && is_back(context, draw, triangle[t]) ? 1 : 0];
      }
      for (int k = 0; k < 3; ++k) {
        const auto of = [&](int t)
                            HWY_ATTR { return context.memory.attributes[k][triangle[t]] + attribute[t]; };
        set_up_four(of(0), of(1), of(2), of(3), component[k], first);
      }
    }
  }
  /// GouraudColorEval::packed(), of pixels of several triangles.
  HWY_INLINE Int packed(const PickByTriangle& pick, Float b1, Float b2) const {
    const auto level = [&](int c) HWY_ATTR {
      const Float at_first = pick(component[0][c]);
      const Float to_second = hn::Sub(pick(component[1][c]), at_first),
                  to_third = hn::Sub(pick(component[2][c]), at_first);
      return truncate(mul_add(b1, to_second, mul_add(b2, to_third, at_first)));
    };
    return hn::Or(hn::Or(hn::ShiftLeftSame(level(0), r_shift), hn::ShiftLeftSame(level(1), g_shift)),
                  level(2));
  }

 private:
#if HWY_TARGET == HWY_SCALAR
  static HWY_INLINE void set_up_four(const float* c0, const float* c1, const float* c2, const float* c3,
                                     float (&to)[3][kGroupSize], int first) {
    for (int c = 0; c < 3; ++c)
      to[c][first] = c0[c], to[c][first + 1] = c1[c], to[c][first + 2] = c2[c], to[c][first + 3] = c3[c];
  }
#else
  // Four rows of r g b and what follows: three columns. Four floats can be read from each.
  static HWY_INLINE void set_up_four(const float* c0, const float* c1, const float* c2, const float* c3,
                                     float (&to)[3][kGroupSize], int first) {
    constexpr hn::CappedTag<float, 4> four;
    constexpr hn::Repartition<double, decltype(four)> pairs;
    const auto r0 = hn::LoadU(four, c0), r1 = hn::LoadU(four, c1), r2 = hn::LoadU(four, c2),
               r3 = hn::LoadU(four, c3);
    const auto rg01 = hn::BitCast(pairs, hn::InterleaveLower(four, r0, r1)),
               rg23 = hn::BitCast(pairs, hn::InterleaveLower(four, r2, r3));  // r r g g
    const auto b01 = hn::BitCast(pairs, hn::InterleaveUpper(four, r0, r1)),
               b23 = hn::BitCast(pairs, hn::InterleaveUpper(four, r2, r3));
    hn::Store(hn::BitCast(four, hn::InterleaveLower(pairs, rg01, rg23)), four, to[0] + first);
    hn::Store(hn::BitCast(four, hn::InterleaveUpper(pairs, rg01, rg23)), four, to[1] + first);
    hn::Store(hn::BitCast(four, hn::InterleaveLower(pairs, b01, b23)), four, to[2] + first);
  }
#endif
};

/// Pixels of a group's small triangles, in the order in which they are drawn, and their colours.
struct SmallTrianglePixels {
  static constexpr int kCapacity = kGroupSize * kBlockPixels;
  int count = 0;
  alignas(64) std::int32_t
      place[kCapacity + kLanes];  // the triangle's number in the group, and y and x in the tile: 8 bits each
  alignas(64) std::int32_t index[kCapacity + kLanes];   // of the pixel
  alignas(64) std::int32_t key[kCapacity + kLanes];     // of its depth, where kHasKeys
  alignas(64) std::int32_t packed[kCapacity + kLanes];  // of its colour
  std::uint32_t triangles = 0;                          // that have pixels
  static_assert(kMaxTileSize <= 256);
  static HWY_INLINE Int x_of(Int at) { return hn::And(at, splat(255)); }
  HWY_INLINE int triangle(int p) const { return place[p] >> 16; }
  static HWY_INLINE Int y_of(Int at) { return hn::And(hn::ShiftRight<8>(at), splat(255)); }

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
  /// Words at barycentric coordinates as barycentric_from_edges() has them. @pre set_up_weights
  HWY_INLINE void set_up(const TileContext& context, const TileDraw& draw) {
    const TriangleGroup& g = context.memory.group;
    SmallTriangleColorEval colors;
    colors.set_up(context, draw, triangles);
    hn::StoreU(hn::Zero(kInt), kInt, place + count);
    for (int first = 0; first < count; first += kLanes) {
      const Int at = hn::Load(kInt, place + first), of_triangle = hn::ShiftRight<16>(at), at_x = x_of(at),
                at_y = y_of(at);
      const PickByTriangle pick(of_triangle);
      hn::StoreU(context.pixel_indices(at_x, at_y), kInt, index + first);
      Float w[3];
      for (int k = 0; k < 3; ++k) {
        const Int edge =
            hn::Add(pick(g.e[k]), hn::Add(hn::Mul(pick(g.a[k]), at_x), hn::Mul(pick(g.b[k]), at_y)));
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
  /// Whether keys come in lanes: of a depth format that they do for, and where products of 64 bits do.
  template <class Depth>
  static constexpr bool kHasKeys = HWY_TARGET == HWY_AVX3&& std::is_same_v<Depth, UnormDepth>;
  /// As UnormDepth::key() has them. @pre set_up
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
      const __m512i low = keys_of([](__m512i all) HWY_ATTR { return _mm512_castsi512_si256(all); }),
                    high = keys_of([](__m512i all) HWY_ATTR { return _mm512_extracti64x4_epi64(all, 1); });
      hn::Store(hn::BitCast(kInt, hn::ShiftRightSame(hn::ConcatOdd(kUint, Uint{high}, Uint{low}), shift)),
                kInt, key + first);
    }
#endif
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace tessera::detail
HWY_AFTER_NAMESPACE();

#endif
