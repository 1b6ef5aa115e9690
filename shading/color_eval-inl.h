// Colors of pixels that are shaded at once, in registers. One evaluator per case; its interface is
//   set_up(...)  once per triangle, line or group of triangles
//   packed(...)  packed colors of one vector of pixels, from where they lie in the primitive
// Colors of batches are evaluated in batch_colors-inl.h.
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
  /// @param first, second, third  colors of the vertices; four floats are readable at each
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

/// RGB and alpha 0..1, blended with stored 8-bit RGB: source * alpha + stored * (1 - alpha). The same bits as
/// FragmentTriangle without its clamps. They change nothing here: values that are clamped to 0..1 at the
/// vertices stay within 0..1 between them, and a sum that rounds to above 1 still gives the highest level.
/// Unclamped alpha, of lit pixels or for alpha tests, never comes here (choose_pixel_path()).
struct BlendedColorEval {
  Interpolant c[4];  // r g b a
  InterpolantLanes lanes[4];
  Float low[4], high[4];
  bool same_alpha = false;    // alpha is the same at all pixels:
  Float one_alpha, one_rest;  // alpha and 1 - alpha, if so

  /// @param flat  r g b a of a flat triangle; else null
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
  /// @pre of packed(), not of packed_pixel()
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
  /// packed() of one pixel, with the same bits.
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
  /// interpolate_clamped() of numbers: no NaN.
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

/// RGB 0..1 at the pixels' centers, where pixels have several samples.
struct MsaaColorEval {
  const ShadedTriangle* triangle = nullptr;
  const ColorLayout* layout = nullptr;
  Interpolant r, g, b;
  Int to_center[3];  // center's edges - dominating edges (MsaaTrianglePixels::edges)

  HWY_INLINE void set_up(const TileContext& context, const TileDraw& draw, const ShadedTriangle& shaded,
                         int i) {
    triangle = &shaded;
    layout = &context.frame.layout;
    const int attribute = draw.color_attribute[shaded.back ? 1 : 0];
    r = make_interpolant(shaded, attribute, true), g = make_interpolant(shaded, attribute + 1, true),
    b = make_interpolant(shaded, attribute + 2, true);
    for (int k = 0; k < 3; ++k)
      to_center[k] =
          hn::Sub(splat(shaded.edges.e[k]), splat(context.memory.samples->samples32.max_edge[k][i]));
  }
  HWY_NOINLINE Int packed(Int e0, Int e1, Int e2) const {
    const Barycentric at = barycentric_from_edges(*triangle, hn::Add(e0, to_center[0]),
                                                  hn::Add(e1, to_center[1]), hn::Add(e2, to_center[2]));
    return pack_colors(
        *layout,
        {{interpolate_clamped(at, r), interpolate_clamped(at, g), interpolate_clamped(at, b), splat(1.0f)}},
        splat(0.5f));
  }
};

/// GouraudColorEval for vectors of pixels of several triangles: vertex colors as arrays over the group.
struct SmallTriangleColorEval {
  alignas(64) float component[3][3][kGroupSize];  // [vertex][r g b][triangle]
  int r_shift, g_shift;

  /// @param triangles  those that have pixels, one bit each; others get undefined colors
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
  // Transposes four rows of r g b and a fourth float that is dropped.
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

/// RGB 0..1 along a line.
struct LineColorEval {
  float first[3], change[3], max_level[3], rw[2];
  int shift[3];

  HWY_INLINE void set_up(const TileContext& context, const TileDraw& draw, int i, bool back) {
    const ColorLayout& layout = context.frame.layout;
    const int bits[3] = {layout.r_bits, layout.g_bits, layout.b_bits},
              shifts[3] = {layout.r_shift(), layout.g_shift(), 0};
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
  /// Equation 3.6
  HWY_INLINE Int packed(const Doubles& parameters) const {
    Float t = to_floats(parameters);
    if (rw[0] != rw[1]) {
      const Float far = hn::Mul(t, splat(rw[1])),
                  sum = hn::Add(hn::Mul(hn::Sub(splat(1.0f), t), splat(rw[0])), far);
      t = hn::Div(far, sum);
      t = hn::IfThenElseZero(hn::IsFinite(t), t);  // as barycentric_edges64
    }
    Int word = hn::Zero(kInt);
    for (int c = 0; c < 3; ++c) {
      const Float color = clamped_unit(mul_add(t, splat(change[c]), splat(first[c])));
      word = hn::Or(word,
                    hn::ShiftLeftSame(truncate(mul_add(color, splat(max_level[c]), splat(0.5f))), shift[c]));
    }
    return word;
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace tessera::detail
HWY_AFTER_NAMESPACE();

#endif
