// The state of one tile while it is rendered, and the colours that are settled at once.
#if defined(TESSERA_SHADING_TILE_CONTEXT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TESSERA_SHADING_TILE_CONTEXT_INL_H_
#undef TESSERA_SHADING_TILE_CONTEXT_INL_H_
#else
#define TESSERA_SHADING_TILE_CONTEXT_INL_H_
#endif

#include <algorithm>
#include <limits>

#include "raster/binning.h"
#include "raster/lanes-inl.h"
#include "shading/fragment_scalar.h"
#include "shading/interpolate-inl.h"
#include "shading/tile_workspace.h"

HWY_BEFORE_NAMESPACE();
namespace tessera::detail {
namespace HWY_NAMESPACE {

struct TileContext {
  const TileFrame& frame;
  TileWorkspace::Memory& memory;
  std::uint32_t* const color;     // memory.color, which stores cannot change
  int tile_x, tile_y, tile_size;  // pixels
  PixelRect rect;                 // of the current draw, tile-relative
  bool needs_scissor = false;     // the rectangle's edges cross blocks
  TileCounts counts;
  int samples = 1;
  TileAttachments sample[kMaxSamples];

  HWY_INLINE int block_index(int bx, int by) const {
    return ((by >> 2) * (tile_size >> 2) + (bx >> 2)) * kBlockPixels;
  }
  HWY_INLINE int pixel_index(int x, int y) const { return block_index(x, y) + (y & 3) * 4 + (x & 3); }
  HWY_INLINE Int pixel_indices(Int x, Int y) const {
    const Int block = hn::Add(hn::Mul(hn::ShiftRight<2>(y), splat(tile_size >> 2)), hn::ShiftRight<2>(x)),
              three = splat(3);
    return hn::Add(hn::ShiftLeft<4>(block), hn::Add(hn::ShiftLeft<2>(hn::And(y, three)), hn::And(x, three)));
  }
};

/// The sum of lanes of minus how many.
HWY_INLINE std::uint64_t count_of(Int negative) {
  alignas(64) std::int32_t lanes[kLanes];
  hn::Store(negative, kInt, lanes);
  std::int64_t sum = 0;
  for (const std::int32_t lane : lanes) sum -= lane;
  return static_cast<std::uint64_t>(sum);
}

inline constexpr std::int32_t kMaxDepthKey = std::numeric_limits<std::int32_t>::max();
/// What is known of all blocks of a tile with several samples: none of their depth keys is greater.
HWY_INLINE void reset_hiz(TileContext& context, std::int32_t key) {
  std::fill_n(context.memory.samples->hiz_max, context.tile_size * context.tile_size / kBlockPixels, key);
}

/// Lanes of a chunk inside the draw's rectangle.
HWY_INLINE auto scissor_mask(const PixelRect& rect, int bx, int by, int chunk) {
  const Int x = hn::Add(splat(bx), block_columns(chunk)), y = hn::Add(splat(by), block_rows(chunk));
  return hn::And(hn::And(hn::Gt(x, splat(rect.x0 - 1)), hn::Gt(splat(rect.x1), x)),
                 hn::And(hn::Gt(y, splat(rect.y0 - 1)), hn::Gt(splat(rect.y1), y)));
}

/// Writes the bits of `writable` in the lanes of `mask`.
template <class Mask>
HWY_INLINE void store_packed(std::uint32_t* color, Int packed, Mask mask, Int writable) {
  auto* target = reinterpret_cast<std::int32_t*>(color);
  const Int stored = hn::Load(kInt, target), changed = hn::And(hn::VecFromMask(kInt, mask), writable);
  hn::Store(hn::Xor(stored, hn::And(hn::Xor(stored, packed), changed)), kInt, target);
}

/// Stores the lanes of `mask` alone.
template <class Tag, class Mask>
HWY_INLINE void store_where(Mask mask, hn::Vec<Tag> value, Tag tag, hn::TFromD<Tag>* to) {
#if HWY_TARGET == HWY_AVX3
  hn::BlendedStore(value, mask, tag, to);
#else  // where masked stores are slow on some processors
  hn::Store(hn::IfThenElse(mask, value, hn::Load(tag, to)), tag, to);
#endif
}
/// As store_packed(), where all bits are writable.
template <class Mask>
HWY_INLINE void store_packed_all_bits(std::uint32_t* color, Int packed, Mask mask) {
  store_where(mask, packed, kInt, reinterpret_cast<std::int32_t*>(color));
}

/// Whether triangle i of the group shows its back: by its own area, or as its polygon does.
HWY_INLINE bool is_back(const TileContext& context, const TileDraw& draw, int i) {
  if (draw.facing != nullptr) return draw.facing[context.memory.source[i]] == Facing::back;
  return !is_front(context.memory.group.signed_area[i], draw.front_is_clockwise);
}

/// Interpolated colours that are scaled to levels: three linear functions and the word's packing.
struct GouraudColorEval {
  InterpolantLanes r, g, b;
  Int r_shift, g_shift;

  HWY_INLINE void set_up(const ShadedTriangle& t, int attribute, const ColorLayout& layout) {
    set_up(t.attributes[0] + attribute, t.attributes[1] + attribute, t.attributes[2] + attribute, layout);
  }
  /// @param first  four floats can be read there, and at the others
  HWY_INLINE void set_up(const float* first, const float* second, const float* third,
                         const ColorLayout& layout) {
#if HWY_TARGET == HWY_SCALAR
    const auto of = [&](int c) { return Interpolant{first[c], second[c] - first[c], third[c] - first[c]}; };
#else
    constexpr hn::CappedTag<float, 4> four;
    alignas(16) float at[3][4];
    const auto at_first = hn::LoadU(four, first);
    hn::Store(at_first, four, at[0]);
    hn::Store(hn::Sub(hn::LoadU(four, second), at_first), four, at[1]);
    hn::Store(hn::Sub(hn::LoadU(four, third), at_first), four, at[2]);
    const auto of = [&](int c) { return Interpolant{at[0][c], at[1][c], at[2][c]}; };
#endif
    r.set(of(0));
    g.set(of(1));
    b.set(of(2));
    r_shift = splat(layout.r_shift());
    g_shift = splat(layout.g_shift());
  }
  HWY_INLINE Int packed(const Barycentric& at) const {
    const Int red = truncate(interpolate(at, r)), green = truncate(interpolate(at, g));
    const Int blue = truncate(interpolate(at, b));
    return hn::Or(hn::Or(hn::Shl(red, r_shift), hn::Shl(green, g_shift)), blue);
  }
};

/// Colours of 0..1 for 8 bits each of red, green and blue, which are mixed by their alpha with what is
/// stored: the steps of FragmentTriangle, of which those are left out that change no bit. What is kept within
/// 0..1 at the vertices is within 0..1 between them, and a sum that rounds to above 1 is the highest level,
/// too. Alpha that is not kept there has no way here: it is of pixels that are lit, or of alpha tests.
struct BlendedColorEval {
  Interpolant c[4];  // r g b a
  InterpolantLanes lanes[4];
  Float low[4], high[4];
  bool same_alpha = false;    // at all pixels
  Float one_alpha, one_rest;  // that one, and what is left of what is stored

  HWY_INLINE void set_up(const ShadedTriangle& t, const TileDraw& draw, const float* flat) {
    const int face = t.back ? 1 : 0;
    const float* const one = draw.source == ColorSource::constant ? draw.color[face].data() : flat;
    const int of_alpha = draw.alpha_attribute[face];
    for (int k = 0; k < 4; ++k) {
      if (one != nullptr) c[k] = of_all(one[k]);
      else if (k < 3) c[k] = clamped(make_interpolant(t, draw.color_attribute[face] + k, true));
      else c[k] = of_alpha >= 0 ? clamped(make_interpolant(t, of_alpha, true)) : of_all(draw.alpha[face]);
    }
    same_alpha = c[3].to_second == 0 && c[3].to_third == 0;
  }
  /// Before packed().
  HWY_INLINE void prepare_lanes() {
    for (int k = 0; k < 4; ++k) {
      lanes[k].set(c[k]);
      low[k] = splat(c[k].low);
      high[k] = splat(c[k].high);
    }
    one_alpha = lesser_of(greater_of(lanes[3].first, low[3]), high[3]);
    one_rest = hn::Sub(splat(1.0f), one_alpha);
  }
  HWY_INLINE Int packed(const Barycentric& at, Int stored) const {
    const Int byte = splat(255);
    const Int below[3] = {hn::And(hn::ShiftRight<16>(stored), byte), hn::And(hn::ShiftRight<8>(stored), byte),
                          hn::And(stored, byte)};
    const Float a = same_alpha ? one_alpha : within(at, 3),
                of_stored = same_alpha ? one_rest : hn::Sub(splat(1.0f), a);
    const auto level = [&](int k) HWY_ATTR {
      const Float mixed = mul_add(
          within(at, k), a, hn::Mul(hn::Mul(hn::ConvertTo(kFloat, below[k]), splat(1.0f / 255)), of_stored));
      return truncate(mul_add(mixed, splat(255.0f), splat(0.5f)));
    };
    return hn::Or(hn::Or(hn::ShiftLeft<16>(level(0)), hn::ShiftLeft<8>(level(1))), level(2));
  }
  /// The same of one pixel.
  HWY_INLINE std::uint32_t packed_pixel(float b1, float b2, std::uint32_t stored) const {
    const auto at_pixel = [&](const Interpolant& k) {
      const float value = std::fma(b1, k.to_second, std::fma(b2, k.to_third, k.first)),
                  raised = value > k.low ? value : k.low;
      return raised < k.high ? raised : k.high;
    };
    const float a = at_pixel(c[3]), rest = 1 - a;
    const auto level = [&](int k, std::uint32_t below) {
      const float own = at_pixel(c[k]);
      return static_cast<std::uint32_t>(
          std::fma(std::fma(own, a, static_cast<float>(below) * (1.0f / 255) * rest), 255.0f, 0.5f));
    };
    return level(0, stored >> 16 & 255) << 16 | level(1, stored >> 8 & 255) << 8 | level(2, stored & 255);
  }

 private:
  /// interpolate_clamped(), of values that are no NaN.
  HWY_INLINE Float within(const Barycentric& at, int k) const {
    return lesser_of(greater_of(interpolate(at, lanes[k]), low[k]), high[k]);
  }
  static HWY_INLINE Interpolant of_all(float value) { return {value, 0, 0, value, value}; }
  static HWY_INLINE Interpolant clamped(Interpolant interpolant) {
    interpolant.low = clamp_unit(interpolant.low);
    interpolant.high = clamp_unit(interpolant.high);
    return interpolant;
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace tessera::detail
HWY_AFTER_NAMESPACE();

#endif
