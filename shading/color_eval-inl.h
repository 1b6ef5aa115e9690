// Colours of pixels that are shaded immediately, in registers. Every evaluator has two functions:
//   set_up(...)  once per triangle, line or group of triangles
//   packed(...)  packed colours of one vector of pixels, from their position in the primitive
// Colours of batches are evaluated in batch_colors-inl.h.
#if defined(TESSERA_SHADING_COLOR_EVAL_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TESSERA_SHADING_COLOR_EVAL_INL_H_
#undef TESSERA_SHADING_COLOR_EVAL_INL_H_
#else
#define TESSERA_SHADING_COLOR_EVAL_INL_H_
#endif

#include <algorithm>
#include <cmath>

#include "shading/fragment_ops-inl.h"
#include "shading/interpolate-inl.h"
#include "shading/pick_by_triangle-inl.h"
#include "shading/point_line_values-inl.h"
#include "shading/tile_context-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tessera::detail {
namespace HWY_NAMESPACE {

/// Interpolated RGB in levels, with the half that rounds.
struct GouraudColorEval {
  InterpolantLanes r, g, b;
  Int r_shift, g_shift;

  HWY_INLINE void set_up(const ShadedTriangle& t, int attribute, const ColorLayout& layout) {
    set_up(t.attributes[0] + attribute, t.attributes[1] + attribute, t.attributes[2] + attribute, layout);
  }
  /// @param first, second, third  colours of the vertices; four floats are readable at each
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
    const Int red = truncate(interpolate(at, r));
    const Int green = truncate(interpolate(at, g));
    const Int blue = truncate(interpolate(at, b));
    return hn::Or(hn::Or(hn::Shl(red, r_shift), hn::Shl(green, g_shift)), blue);
  }
};

/// RGB and alpha 0..1, blended with stored 8-bit RGB: source * alpha + stored * (1 - alpha). Bit-identical to
/// FragmentTriangle, but without its clamps, which would change nothing: values that are clamped to 0..1 at
/// the vertices stay within 0..1 between them, and a sum that rounds to above 1 still gives the highest
/// level. Draws with unclamped alpha (lit pixels, alpha tests) take another path (choose_pixel_path()).
struct BlendedColorEval {
  Interpolant c[4];  // r g b a
  InterpolantLanes lanes[4];
  Float low[4], high[4];
  bool same_alpha = false;  // alpha is the same at all pixels
  Float one_alpha;          // same_alpha: alpha
  Float one_minus_alpha;    // same_alpha: 1 - alpha

  /// @param flat  r g b a of a flat triangle; else null
  HWY_INLINE void set_up(const ShadedTriangle& t, const TileDraw& draw, const float* flat) {
    const int face = t.back ? 1 : 0;
    const float* const one_color = draw.source == ColorSource::constant ? draw.color[face].data() : flat;
    const int alpha_attribute = draw.alpha_attribute[face];
    for (int k = 0; k < 4; ++k) {
      if (one_color != nullptr) c[k] = constant(one_color[k]);
      else if (k < 3) c[k] = clamped(make_interpolant(t, draw.color_attribute[face] + k, true));
      else if (alpha_attribute >= 0) c[k] = clamped(make_interpolant(t, alpha_attribute, true));
      else c[k] = constant(draw.alpha[face]);
    }
    same_alpha = c[3].to_second == 0 && c[3].to_third == 0;
  }
  /// Must be called before packed(). packed_pixel() does not need it.
  HWY_INLINE void prepare_lanes() {
    for (int k = 0; k < 4; ++k) {
      lanes[k].set(c[k]);
      low[k] = splat(c[k].low);
      high[k] = splat(c[k].high);
    }
    one_alpha = lesser_of(greater_of(lanes[3].first, low[3]), high[3]);
    one_minus_alpha = hn::Sub(splat(1.0f), one_alpha);
  }
  HWY_INLINE Int packed(const Barycentric& at, Int stored) const {
    const Int byte = splat(255);
    const Int stored_level[3] = {hn::And(hn::ShiftRight<16>(stored), byte),
                                 hn::And(hn::ShiftRight<8>(stored), byte), hn::And(stored, byte)};
    const Float alpha = same_alpha ? one_alpha : within(at, 3);
    const Float rest = same_alpha ? one_minus_alpha : hn::Sub(splat(1.0f), alpha);
    const auto level = [&](int k) HWY_ATTR {
      const Float stored_color = hn::Mul(hn::ConvertTo(kFloat, stored_level[k]), splat(1.0f / 255));
      const Float mixed = mul_add(within(at, k), alpha, hn::Mul(stored_color, rest));
      return truncate(mul_add(mixed, splat(255.0f), splat(0.5f)));
    };
    return hn::Or(hn::Or(hn::ShiftLeft<16>(level(0)), hn::ShiftLeft<8>(level(1))), level(2));
  }
  /// packed() of one pixel, with the same bits.
  HWY_INLINE std::uint32_t packed_pixel(float b1, float b2, std::uint32_t stored) const {
    const auto at_pixel = [&](const Interpolant& k) {
      const float value = std::fma(b1, k.to_second, std::fma(b2, k.to_third, k.first));
      const float raised = value > k.low ? value : k.low;
      return raised < k.high ? raised : k.high;
    };
    const float alpha = at_pixel(c[3]);
    const float rest = 1 - alpha;
    const auto level = [&](int k, std::uint32_t stored_level) {
      const float stored_color = static_cast<float>(stored_level) * (1.0f / 255);
      const float mixed = std::fma(at_pixel(c[k]), alpha, stored_color * rest);
      return static_cast<std::uint32_t>(std::fma(mixed, 255.0f, 0.5f));
    };
    return level(0, stored >> 16 & 255) << 16 | level(1, stored >> 8 & 255) << 8 | level(2, stored & 255);
  }

 private:
  /// interpolate_clamped() of component k.
  HWY_INLINE Float within(const Barycentric& at, int k) const {
    return lesser_of(greater_of(interpolate(at, lanes[k]), low[k]), high[k]);
  }
  static HWY_INLINE Interpolant constant(float value) { return {value, 0, 0, value, value}; }
  static HWY_INLINE Interpolant clamped(Interpolant interpolant) {
    interpolant.low = clamp_unit(interpolant.low);
    interpolant.high = clamp_unit(interpolant.high);
    return interpolant;
  }
};

/// RGB 0..1 at pixels' centres, for frames with several samples.
struct MsaaColorEval {
  const ShadedTriangle* triangle = nullptr;
  const ColorLayout* layout = nullptr;
  Interpolant r, g, b;
  Int to_center[3];  // edges at pixels' centres minus dominating edges (MsaaTrianglePixels::edges)

  HWY_INLINE void set_up(const TileContext& context, const TileDraw& draw, const ShadedTriangle& shaded,
                         int i) {
    triangle = &shaded;
    layout = &context.frame.layout;
    const int attribute = draw.color_attribute[shaded.back ? 1 : 0];
    r = make_interpolant(shaded, attribute, true);
    g = make_interpolant(shaded, attribute + 1, true);
    b = make_interpolant(shaded, attribute + 2, true);
    const SampleGroup& samples = context.memory.samples->samples32;
    for (int k = 0; k < 3; ++k)
      to_center[k] = hn::Sub(splat(shaded.edges.e[k]), splat(samples.max_edge[k][i]));
  }
  /// @param e0, e1, e2  dominating edges at the pixels
  HWY_NOINLINE Int packed(Int e0, Int e1, Int e2) const {
    const Barycentric at = barycentric_from_edges(*triangle, hn::Add(e0, to_center[0]),
                                                  hn::Add(e1, to_center[1]), hn::Add(e2, to_center[2]));
    const Colors colors{
        {interpolate_clamped(at, r), interpolate_clamped(at, g), interpolate_clamped(at, b), splat(1.0f)}};
    return pack_colors(*layout, colors, splat(0.5f));
  }
};

/// GouraudColorEval for vectors of pixels of several triangles, with arrays of vertex colours over the group.
struct SmallTriangleColorEval {
  alignas(64) float component[3][3][kGroupSize];  // [vertex][r g b][triangle]
  int r_shift, g_shift;

  /// @param triangles  triangles with pixels, one bit each; the colours of others are undefined
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
  /// As GouraudColorEval::packed().
  HWY_INLINE Int packed(const PickByTriangle& pick, Float b1, Float b2) const {
    const auto level = [&](int c) HWY_ATTR {
      const Float at_first = pick(component[0][c]);
      const Float to_second = hn::Sub(pick(component[1][c]), at_first);
      const Float to_third = hn::Sub(pick(component[2][c]), at_first);
      return truncate(mul_add(b1, to_second, mul_add(b2, to_third, at_first)));
    };
    return hn::Or(hn::Or(hn::ShiftLeftSame(level(0), r_shift), hn::ShiftLeftSame(level(1), g_shift)),
                  level(2));
  }

 private:
  // Transposes r g b of four triangles: writes four elements of each component of `to` from `first` on.
#if HWY_TARGET == HWY_SCALAR
  static HWY_INLINE void set_up_four(const float* c0, const float* c1, const float* c2, const float* c3,
                                     float (&to)[3][kGroupSize], int first) {
    for (int c = 0; c < 3; ++c) {
      to[c][first] = c0[c];
      to[c][first + 1] = c1[c];
      to[c][first + 2] = c2[c];
      to[c][first + 3] = c3[c];
    }
  }
#else
  static HWY_INLINE void set_up_four(const float* c0, const float* c1, const float* c2, const float* c3,
                                     float (&to)[3][kGroupSize], int first) {
    constexpr hn::CappedTag<float, 4> four;
    constexpr hn::Repartition<double, decltype(four)> pairs;
    // Each row is r g b and a float that is dropped.
    const auto row0 = hn::LoadU(four, c0);
    const auto row1 = hn::LoadU(four, c1);
    const auto row2 = hn::LoadU(four, c2);
    const auto row3 = hn::LoadU(four, c3);
    const auto rrgg01 = hn::BitCast(pairs, hn::InterleaveLower(four, row0, row1));
    const auto rrgg23 = hn::BitCast(pairs, hn::InterleaveLower(four, row2, row3));
    const auto bb01 = hn::BitCast(pairs, hn::InterleaveUpper(four, row0, row1));
    const auto bb23 = hn::BitCast(pairs, hn::InterleaveUpper(four, row2, row3));
    hn::Store(hn::BitCast(four, hn::InterleaveLower(pairs, rrgg01, rrgg23)), four, to[0] + first);
    hn::Store(hn::BitCast(four, hn::InterleaveUpper(pairs, rrgg01, rrgg23)), four, to[1] + first);
    hn::Store(hn::BitCast(four, hn::InterleaveLower(pairs, bb01, bb23)), four, to[2] + first);
  }
#endif
};

/// RGB 0..1 along a line.
struct LineColorEval {
  float first[3];      // at the first vertex
  float change[3];     // from the first vertex to the second
  float max_level[3];  // 2^bits - 1
  int shift[3];        // bit offset in packed colours
  float rw[2];         // 1/w of the vertices (RelativeRw)

  HWY_INLINE void set_up(const TileContext& context, const TileDraw& draw, int i, bool back) {
    const ColorLayout& layout = context.frame.layout;
    const int bits[3] = {layout.r_bits, layout.g_bits, layout.b_bits};
    const int shifts[3] = {layout.r_shift(), layout.g_shift(), 0};
    for (int c = 0; c < 3; ++c) {
      const int attribute = draw.color_attribute[back ? 1 : 0] + c;
      first[c] = context.memory.attributes[0][i][attribute];
      change[c] = context.memory.attributes[1][i][attribute] - first[c];
      max_level[c] = static_cast<float>((1 << bits[c]) - 1);
      shift[c] = shifts[c];
    }
    const RelativeRw relative(context.memory.group, i, 1);
    for (int k = 0; k < 2; ++k) rw[k] = relative.of[k];
  }
  /// [GL 2.1, equation 3.6]
  /// @param parameters  LineValues::parameters()
  HWY_INLINE Int packed(const Doubles& parameters) const {
    Float t = to_floats(parameters);
    if (rw[0] != rw[1]) {
      const Float second = hn::Mul(t, splat(rw[1]));
      const Float sum = hn::Add(hn::Mul(hn::Sub(splat(1.0f), t), splat(rw[0])), second);
      t = hn::Div(second, sum);
      t = hn::IfThenElseZero(hn::IsFinite(t), t);  // as in barycentric_edges64()
    }
    Int packed = hn::Zero(kInt);
    for (int c = 0; c < 3; ++c) {
      const Float color = clamped_unit(mul_add(t, splat(change[c]), splat(first[c])));
      const Int level = truncate(mul_add(color, splat(max_level[c]), splat(0.5f)));
      packed = hn::Or(packed, hn::ShiftLeftSame(level, shift[c]));
    }
    return packed;
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace tessera::detail
HWY_AFTER_NAMESPACE();

#endif
