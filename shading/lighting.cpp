// Kernels of the lighting equation: stages over a batch of points, one variant per kind of light and of
// highlight.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shading/lighting.cpp"
#include "framebuffer/lanes.h"

#include <array>

#include "shading/lighting.h"
#include "shading/power-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tessera::detail {
namespace HWY_NAMESPACE {

struct Vector {
  Float x, y, z;
};
HWY_INLINE Float dot(const Vector& a, const Vector& b) {
  return mul_add(a.x, b.x, mul_add(a.y, b.y, hn::Mul(a.z, b.z)));
}
HWY_INLINE Vector times(const Vector& v, Float s) {
  return {hn::Mul(v.x, s), hn::Mul(v.y, s), hn::Mul(v.z, s)};
}
/// a - b s
HWY_INLINE Vector less_times(const Vector& a, const Vector& b, Float s) {
  return {neg_mul_add(b.x, s, a.x), neg_mul_add(b.y, s, a.y), neg_mul_add(b.z, s, a.z)};
}
HWY_INLINE Float squared_length(const Vector& v) { return dot(v, v); }
/// Cosine of the angle between unit vectors with the difference `apart`: 1 - |apart|^2 / 2. Near 1 the error
/// is relative to the difference from 1.
HWY_INLINE Float cosine_of_units(const Vector& apart) {
  return mul_add(splat(-0.5f), squared_length(apart), splat(1.0f));
}
HWY_INLINE Vector splat_vector(const std::array<float, 3>& v) {
  return {splat(v[0]), splat(v[1]), splat(v[2])};
}
HWY_INLINE Vector load_vector(const ShadingBatch& batch, int first_field, int point) {
  return {hn::Load(kFloat, batch.field[first_field] + point),
          hn::Load(kFloat, batch.field[first_field + 1] + point),
          hn::Load(kFloat, batch.field[first_field + 2] + point)};
}
HWY_INLINE void store_vector(ShadingBatch& batch, int first_field, int point, const Vector& v) {
  hn::Store(v.x, kFloat, batch.field[first_field] + point);
  hn::Store(v.y, kFloat, batch.field[first_field + 1] + point);
  hn::Store(v.z, kFloat, batch.field[first_field + 2] + point);
}
/// 1/sqrt(x), and 0 for x <= 0: so that normalize(0) = 0. Root and division are exact on every target.
HWY_INLINE Float inverse_length(Float squared) {
  return hn::IfThenElseZero(hn::Gt(squared, hn::Zero(kFloat)), hn::Div(splat(1.0f), hn::Sqrt(squared)));
}
/// sum += intensity * colour
HWY_INLINE void accumulate(Vector& sum, Float intensity, const Vector& color) {
  sum.x = mul_add(intensity, color.x, sum.x);
  sum.y = mul_add(intensity, color.y, sum.y);
  sum.z = mul_add(intensity, color.z, sum.z);
}

/// Results that the stages of one light pass on. Each stage runs over all points before the next begins:
/// roots and divisions of several chunks overlap, and an empty stage is skipped by one test.
struct alignas(64) Incidence {
  float to_light[3][kBatchPoints];  // unit
  float n_dot_l[kBatchPoints];      // 0 if the light is behind the surface or does not reach the point
  float factor[kBatchPoints];       // att, or 0 if the light does not reach the point; then att * spot
  float cosine[kBatchPoints];       // angle to a spot's axis
  float highlight[kBatchPoints];    // S.n, its square or R.E

  HWY_INLINE Vector direction(int point) const {
    return {hn::Load(kFloat, to_light[0] + point), hn::Load(kFloat, to_light[1] + point),
            hn::Load(kFloat, to_light[2] + point)};
  }
};

HWY_INLINE Float clamp_finite(Float amount) { return lesser_of(amount, splat(kMaxFloat)); }

/// Computes direction and attenuation of the light at each point, without the spot factor. Returns whether
/// any point faces the light.
template <LightKind kKind>
HWY_NOINLINE bool find_incidence(const LightTerm& term, const ShadingBatch& batch, int count,
                                 Incidence& light) {
  constexpr bool kAttenuated = kKind == LightKind::attenuated_point || kKind == LightKind::attenuated_spot;
  const Float zero = hn::Zero(kFloat), one = splat(1.0f);
  // Loaded before the loop: the compiler must assume that stores change `term`.
  const Vector from = splat_vector(term.position), attenuation = splat_vector(term.attenuation),
               spot_direction = splat_vector(term.spot_direction);
  const Float spot_cosine = splat(term.spot_cosine), spot_chord_squared = splat(term.spot_chord_squared);
  const bool narrow = term.spot_chord_squared > 0;
  auto any = hn::Gt(zero, zero);
  for (int point = 0; point < count; point += kLanes) {
    Vector to_light = from;
    Float factor = one;
    if constexpr (kKind != LightKind::directional) {
      const Vector position = load_vector(batch, kPositionX, point);
      to_light = {hn::Sub(from.x, position.x), hn::Sub(from.y, position.y), hn::Sub(from.z, position.z)};
      const Float squared = dot(to_light, to_light);
      const Float distance = hn::Sqrt(squared);
      to_light = times(to_light, hn::IfThenElseZero(hn::Gt(squared, zero), hn::Div(one, distance)));
      if constexpr (kAttenuated) {
        const Float denominator = mul_add(attenuation.z, clamp_finite(squared),
                                          mul_add(attenuation.y, clamp_finite(distance), attenuation.x));
        factor =
            hn::IfThenElse(hn::Gt(denominator, zero), clamp_finite(hn::Div(one, denominator)), splat(1.0e6f));
      }
    }
    const Float n_dot_l = dot(load_vector(batch, kNormalX, point), to_light);
    auto facing = hn::Gt(n_dot_l, zero);
    if constexpr (is_spot(kKind)) {
      const Float cosine = hn::Sub(zero, dot(to_light, spot_direction));
      auto reached = hn::Ge(cosine, spot_cosine);
      if (HWY_UNLIKELY(narrow))
        reached =
            hn::Le(squared_length(less_times(to_light, spot_direction, splat(-1.0f))), spot_chord_squared);
      reached = hn::And(reached, hn::Gt(cosine, zero));
      hn::Store(cosine, kFloat, light.cosine + point);
      factor = hn::IfThenElseZero(reached, factor);
      facing = hn::And(facing, reached);
    }
    any = hn::Or(any, facing);
    hn::Store(to_light.x, kFloat, light.to_light[0] + point);
    hn::Store(to_light.y, kFloat, light.to_light[1] + point);
    hn::Store(to_light.z, kFloat, light.to_light[2] + point);
    hn::Store(hn::IfThenElseZero(facing, clamp_finite(n_dot_l)), kFloat, light.n_dot_l + point);
    hn::Store(factor, kFloat, light.factor + point);
  }
  return !hn::AllFalse(kFloat, any);
}
bool find_incidence(const LightTerm& term, const ShadingBatch& batch, int count, Incidence& light) {
  switch (term.kind) {
    case LightKind::directional: return find_incidence<LightKind::directional>(term, batch, count, light);
    case LightKind::point: return find_incidence<LightKind::point>(term, batch, count, light);
    case LightKind::attenuated_point:
      return find_incidence<LightKind::attenuated_point>(term, batch, count, light);
    case LightKind::spot: return find_incidence<LightKind::spot>(term, batch, count, light);
    default: return find_incidence<LightKind::attenuated_spot>(term, batch, count, light);
  }
}

/// Calls visit(point, x^power of the points) for each chunk, in order. Powers of several chunks overlap.
template <class Visit>
HWY_INLINE void for_each_power(const Power& power, const float* x, int count, const Visit& visit) {
  constexpr int kTogether = 4;
  with_power(power, [&](const auto& raise) HWY_ATTR {
    for (int first = 0; first < count; first += kTogether * kLanes) {
      Float powers[kTogether];
      for (int k = 0; k < kTogether; ++k)
        powers[k] = first + k * kLanes < count ? hn::Load(kFloat, x + first + k * kLanes) : hn::Zero(kFloat);
      raise(powers);
      for (int k = 0; k < kTogether && first + k * kLanes < count; ++k) visit(first + k * kLanes, powers[k]);
    }
  });
}

/// Applies the spot factor.
void apply_cone(const LightTerm& term, int count, Incidence& light) {
  for_each_power(term.spot_power, light.cosine, count, [&](int point, Float share) HWY_ATTR {
    hn::Store(clamp_finite(hn::Mul(share, hn::Load(kFloat, light.factor + point))), kFloat,
              light.factor + point);
  });
}

/// Points that may have a visible highlight: they face the light, and their base exceeds highlight_floor.
HWY_INLINE auto is_shiny(Float floor, const Incidence& light, int point) {
  return hn::AndNot(hn::Le(hn::Load(kFloat, light.highlight + point), floor),
                    hn::Gt(hn::Load(kFloat, light.n_dot_l + point), hn::Zero(kFloat)));
}

/// Computes the base of the highlight: S.n, its square, or R.E. Returns whether any point has a highlight.
/// @param kFixedHalf  S is the same for all points: directional light, infinite viewer
template <HighlightKind kHighlight, bool kFixedHalf>
HWY_NOINLINE bool find_highlights(const LightTerm& term, const ShadingBatch& batch, int count,
                                  Incidence& light) {
  static_assert(!kFixedHalf || kHighlight == HighlightKind::blinn_infinite);
  constexpr bool kBlinn =
      kHighlight == HighlightKind::blinn_infinite || kHighlight == HighlightKind::blinn_local;
  constexpr bool kLocal =
      kHighlight == HighlightKind::blinn_local || kHighlight == HighlightKind::phong_local;
  const Float zero = hn::Zero(kFloat), floor = splat(term.highlight_floor);
  const Vector fixed_half = splat_vector(term.half_vector);
  const bool sharp = term.sharp, squared_power = term.squared;
  auto any = hn::Gt(zero, zero);
  for (int point = 0; point < count; point += kLanes) {
    const Vector normal = load_vector(batch, kNormalX, point);
    Float base;
    if constexpr (kFixedHalf) {
      base = dot(normal, fixed_half);
      if (HWY_UNLIKELY(sharp)) base = cosine_of_units(less_times(normal, fixed_half, splat(1.0f)));
    } else {
      const Vector to_light = light.direction(point);
      const Vector view = kLocal ? load_vector(batch, kViewX, point) : Vector{zero, zero, splat(1.0f)};
      const Vector half{hn::Add(to_light.x, view.x), hn::Add(to_light.y, view.y),
                        hn::Add(to_light.z, view.z)};
      const Float n_dot_l = hn::Load(kFloat, light.n_dot_l + point),
                  n_dot_v = kLocal ? hn::Load(kFloat, batch.field[kNormalDotView] + point) : normal.z;
      if constexpr (kBlinn) {  // S = normalize(L + E)
        const Float squared = dot(half, half), sum = hn::Add(n_dot_l, n_dot_v);
        if (HWY_LIKELY(squared_power)) {
          const Float kept = greater_of(sum, zero);
          base = hn::IfThenElseZero(hn::Gt(squared, zero), hn::Div(hn::Mul(kept, kept), squared));
        } else {
          const Float inverse = inverse_length(squared);
          base = sharp ? cosine_of_units(less_times(normal, half, inverse)) : hn::Mul(sum, inverse);
        }
      } else {  // R = 2 (L.n) n - L
        const Float twice = hn::Add(n_dot_l, n_dot_l);
        base = hn::Sub(hn::Mul(twice, n_dot_v), kLocal ? dot(to_light, view) : to_light.z);
        if (HWY_UNLIKELY(sharp)) base = cosine_of_units(less_times(half, normal, twice));  // E - R
      }
    }
    hn::Store(base, kFloat, light.highlight + point);
    any = hn::Or(any, is_shiny(floor, light, point));
  }
  return !hn::AllFalse(kFloat, any);
}
bool find_highlights(const LightTerm& term, const ShadingBatch& batch, int count, Incidence& light) {
  switch (term.highlight) {
    case HighlightKind::none: return false;
    case HighlightKind::blinn_infinite:
      return term.kind == LightKind::directional
                 ? find_highlights<HighlightKind::blinn_infinite, true>(term, batch, count, light)
                 : find_highlights<HighlightKind::blinn_infinite, false>(term, batch, count, light);
    case HighlightKind::blinn_local:
      return find_highlights<HighlightKind::blinn_local, false>(term, batch, count, light);
    case HighlightKind::phong_infinite:
      return find_highlights<HighlightKind::phong_infinite, false>(term, batch, count, light);
    default: return find_highlights<HighlightKind::phong_local, false>(term, batch, count, light);
  }
}

/// Three sums per point; one start value for all points until a light has been added.
struct Sums {
  BatchField first_field;
  Rgb start;
  bool begun = false;

  HWY_INLINE Vector load(const ShadingBatch& batch, int point) const {
    return begun ? load_vector(batch, first_field, point) : splat_vector(start);
  }
};

/// Adds the diffuse and, if there is one, the specular term of a light to a chunk of points.
template <class... Highlight>
HWY_INLINE void add_products(const Incidence& light, int point, const Vector& diffuse_color,
                             const Vector& specular_color, const Sums& sums, ShadingBatch& batch,
                             Highlight... highlight) {
  const Float diffuse =
      clamp_finite(hn::Mul(hn::Load(kFloat, light.n_dot_l + point), hn::Load(kFloat, light.factor + point)));
  Vector sum = sums.load(batch, point);
  accumulate(sum, diffuse, diffuse_color);
  (accumulate(sum, highlight, specular_color), ...);
  store_vector(batch, sums.first_field, point, sum);
}
/// Adds the terms of a light to all points, with spec * att * spot if any point has a highlight.
void add_colors(const LightTerm& term, bool has_tracked, bool highlights, int count, const Incidence& light,
                Sums& color, Sums& tracked, ShadingBatch& batch) {
  // Loaded before the loops, as in find_incidence().
  const Vector diffuse = splat_vector(term.diffuse), specular = splat_vector(term.specular);
  const Float floor = splat(term.highlight_floor);
  const auto add = [&, color, tracked, has_tracked, diffuse, specular](int point, auto... highlight)
                       HWY_ATTR {
                         add_products(light, point, diffuse, specular, color, batch, highlight...);
                         if (has_tracked)
                           add_products(light, point, splat_vector(term.tracked_diffuse),
                                        splat_vector(term.tracked_specular), tracked, batch, highlight...);
                       };
  if (highlights) {
    for_each_power(
        term.highlight_power, light.highlight, count, [&, add, floor](int point, Float power) HWY_ATTR {
          const Float highlight = clamp_finite(hn::Mul(power, hn::Load(kFloat, light.factor + point)));
          add(point, hn::IfThenElseZero(is_shiny(floor, light, point), highlight));
        });
  } else {
    for (int point = 0; point < count; point += kLanes) add(point);
  }
  color.begun = true;
  tracked.begun = has_tracked;
}
HWY_NOINLINE void add_ambient(const Incidence& light, int count, const Rgb& color, Sums& sums,
                              ShadingBatch& batch) {
  for (int point = 0; point < count; point += kLanes) {
    Vector sum = sums.load(batch, point);
    accumulate(sum, hn::Load(kFloat, light.factor + point), splat_vector(color));
    store_vector(batch, sums.first_field, point, sum);
  }
  sums.begun = true;
}

/// Adds one light to the sums.
void add_light(const LightTerm& term, bool has_tracked, int count, Sums& color, Sums& tracked,
               ShadingBatch& batch) {
  const bool has_ambient = !is_black(term.ambient) || !is_black(term.tracked_ambient);
  Incidence light;
  const bool faces = find_incidence(term, batch, count, light);
  if (!faces && !has_ambient) return;  // adds exact zeros only
  if (is_spot(term.kind) && term.spot_power.exponent != 0) apply_cone(term, count, light);
  if (has_ambient) {
    add_ambient(light, count, term.ambient, color, batch);
    if (has_tracked) add_ambient(light, count, term.tracked_ambient, tracked, batch);
  }
  if (!faces) return;
  const bool shines = find_highlights(term, batch, count, light);
  add_colors(term, has_tracked, shines, count, light, color, tracked, batch);
}

/// Clamps to finite numbers, so that a product with 0 is 0. A NaN becomes the lowest.
HWY_INLINE Float finite(Float c) { return lesser_of(greater_of(c, splat(-kMaxFloat)), splat(kMaxFloat)); }
/// 0..1; a NaN becomes 0.
HWY_INLINE Float clamped(Float c) {
  const Float zero = hn::Zero(kFloat), one = splat(1.0f);
  return lesser_of(greater_of(c, zero), one);
}

/// Normalizes the normals, flips those of back faces, and computes the direction to the viewer.
void prepare_surfaces(const LightingProgram& program, ShadingBatch& batch, int count) {
  const Float zero = hn::Zero(kFloat);
  for (int point = 0; point < count; point += kLanes) {
    Vector normal = load_vector(batch, kNormalX, point);
    Float scale = program.renormalize ? inverse_length(dot(normal, normal)) : splat(1.0f);
    if (program.negate_normal) scale = hn::Sub(zero, scale);
    normal = times(normal, scale);
    store_vector(batch, kNormalX, point, normal);
    if (!program.needs_view) continue;
    const Vector position = load_vector(batch, kPositionX, point);
    const Vector view = times(position, hn::Sub(zero, inverse_length(dot(position, position))));
    store_vector(batch, kViewX, point, view);
    hn::Store(dot(normal, view), kFloat, batch.field[kNormalDotView] + point);
  }
}

/// index = min(a + d (1 - s) (dm - a) + s (sm - a), sm), masked, from d in red and s in green.
HWY_INLINE Float index_of(const LightingProgram& program, const Vector& sums) {
  const auto [ambient, diffuse, specular] = program.indexes;
  const Float d = finite(sums.x), s = finite(sums.y);
  const Float matt = mul_add(hn::Mul(d, hn::Sub(splat(1.0f), s)), splat(diffuse - ambient), splat(ambient));
  const Float index = lesser_of(mul_add(s, splat(specular - ambient), matt), splat(specular));
  const Float rest = hn::Sub(index, hn::Mul(splat(program.index_modulus),
                                            hn::Floor(hn::Mul(index, splat(1 / program.index_modulus)))));
  return hn::IfThenElseZero(hn::Ge(rest, hn::Zero(kFloat)), rest);
}

void light_points_lanes(const LightingProgram& program, ShadingBatch& batch, int count) {
  if (program.needs_normal && (program.renormalize || program.negate_normal || program.needs_view))
    prepare_surfaces(program, batch, count);
  Sums color{kColorR, program.base}, tracked{kTrackedR, program.tracked_base};
  for (const LightTerm& term : program.terms) add_light(term, program.tracked, count, color, tracked, batch);
  for (int point = 0; point < count; point += kLanes) {
    Vector sum = color.load(batch, point);
    if (program.index) {
      hn::Store(index_of(program, sum), kFloat, batch.field[kColorR] + point);
      continue;
    }
    if (program.tracked) {
      const Vector part = tracked.load(batch, point), vertex = load_vector(batch, kVertexR, point);
      sum = {mul_add(finite(part.x), finite(vertex.x), sum.x),
             mul_add(finite(part.y), finite(vertex.y), sum.y),
             mul_add(finite(part.z), finite(vertex.z), sum.z)};
    }
    store_vector(batch, kColorR, point, {clamped(sum.x), clamped(sum.y), clamped(sum.z)});
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tessera::detail {

LightPoints* light_points(InstructionSet isa) { return TESSERA_KERNEL(isa, light_points_lanes); }

}  // namespace tessera::detail
#endif
