// Terms of one light at a batch of points: direction, attenuation, cone, and the base of the highlight. Each
// stage runs over all points before the next begins: roots and divisions of several chunks overlap, and an
// empty stage is skipped by one test. Twin: lighting_reference.h.
#if defined(TESSERA_SHADING_LIGHT_TERMS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TESSERA_SHADING_LIGHT_TERMS_INL_H_
#undef TESSERA_SHADING_LIGHT_TERMS_INL_H_
#else
#define TESSERA_SHADING_LIGHT_TERMS_INL_H_
#endif

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

/// 1/sqrt(squared); 0 if squared <= 0, so that normalize(0) = 0. Root and division are exact on every target.
HWY_INLINE Float inverse_length(Float squared) {
  return hn::IfThenElseZero(hn::Gt(squared, hn::Zero(kFloat)), hn::Div(splat(1.0f), hn::Sqrt(squared)));
}
/// Results that the stages of one light pass on.
struct alignas(64) Incidence {
  float to_light[3][kBatchPoints];  // unit
  float n_dot_l[kBatchPoints];      // 0 if the light is behind the surface or does not reach the point
  float factor[kBatchPoints];       // att * spot; 0 if the light does not reach the point
  float cosine[kBatchPoints];       // cosine of the angle to the axis of a spot light
  float highlight[kBatchPoints];    // base of the highlight: S.n, its square or R.E

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
  const Float zero = hn::Zero(kFloat);
  const Float one = splat(1.0f);
  // Loaded before the loop: the compiler must assume that stores change `term`.
  const Vector light_position = splat_vector(term.position);
  const Vector attenuation = splat_vector(term.attenuation);
  const Vector spot_direction = splat_vector(term.spot_direction);
  const Float spot_cosine = splat(term.spot_cosine);
  const Float spot_chord_squared = splat(term.spot_chord_squared);
  const bool is_narrow = term.spot_chord_squared > 0;
  auto any_facing = hn::Gt(zero, zero);
  for (int point = 0; point < count; point += kLanes) {
    Vector to_light = light_position;
    Float factor = one;
    if constexpr (kKind != LightKind::directional) {
      const Vector position = load_vector(batch, kPositionX, point);
      to_light = {hn::Sub(light_position.x, position.x), hn::Sub(light_position.y, position.y),
                  hn::Sub(light_position.z, position.z)};
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
      if (HWY_UNLIKELY(is_narrow)) {
        const Vector from_axis = less_times(to_light, spot_direction, splat(-1.0f));
        reached = hn::Le(squared_length(from_axis), spot_chord_squared);
      }
      reached = hn::And(reached, hn::Gt(cosine, zero));
      hn::Store(cosine, kFloat, light.cosine + point);
      factor = hn::IfThenElseZero(reached, factor);
      facing = hn::And(facing, reached);
    }
    any_facing = hn::Or(any_facing, facing);
    hn::Store(to_light.x, kFloat, light.to_light[0] + point);
    hn::Store(to_light.y, kFloat, light.to_light[1] + point);
    hn::Store(to_light.z, kFloat, light.to_light[2] + point);
    hn::Store(hn::IfThenElseZero(facing, clamp_finite(n_dot_l)), kFloat, light.n_dot_l + point);
    hn::Store(factor, kFloat, light.factor + point);
  }
  return !hn::AllFalse(kFloat, any_facing);
}

inline bool find_incidence(const LightTerm& term, const ShadingBatch& batch, int count, Incidence& light) {
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

/// Multiplies the factors, so far the attenuation, by the spot factor.
inline HWY_NOINLINE void apply_cone(const LightTerm& term, int count, Incidence& light) {
  for_each_power(term.spot_power, light.cosine, count, [&](int point, Float spot) HWY_ATTR {
    hn::Store(clamp_finite(hn::Mul(spot, hn::Load(kFloat, light.factor + point))), kFloat,
              light.factor + point);
  });
}

/// Points that may have a visible highlight: they face the light, and their base exceeds `floor`.
/// @param floor  LightTerm::highlight_floor
HWY_INLINE auto is_shiny(Float floor, const Incidence& light, int point) {
  return hn::AndNot(hn::Le(hn::Load(kFloat, light.highlight + point), floor),
                    hn::Gt(hn::Load(kFloat, light.n_dot_l + point), hn::Zero(kFloat)));
}

/// Computes the base of the highlight: S.n, its square, or R.E. Returns whether any point has a highlight.
/// @param kFixedHalf  S is constant: directional light, infinite viewer
template <HighlightKind kHighlight, bool kFixedHalf>
HWY_NOINLINE bool find_highlights(const LightTerm& term, const ShadingBatch& batch, int count,
                                  Incidence& light) {
  static_assert(!kFixedHalf || kHighlight == HighlightKind::blinn_infinite);
  constexpr bool kBlinn =
      kHighlight == HighlightKind::blinn_infinite || kHighlight == HighlightKind::blinn_local;
  constexpr bool kLocal =
      kHighlight == HighlightKind::blinn_local || kHighlight == HighlightKind::phong_local;
  const Float zero = hn::Zero(kFloat);
  const Float floor = splat(term.highlight_floor);
  const Vector fixed_half = splat_vector(term.half_vector);
  const bool is_sharp = term.sharp;
  const bool uses_square = term.squared;
  auto any_shiny = hn::Gt(zero, zero);
  for (int point = 0; point < count; point += kLanes) {
    const Vector normal = load_vector(batch, kNormalX, point);
    Float base;
    if constexpr (kFixedHalf) {
      base = dot(normal, fixed_half);
      if (HWY_UNLIKELY(is_sharp)) base = cosine_of_units(less_times(normal, fixed_half, splat(1.0f)));
    } else {
      const Vector to_light = light.direction(point);
      const Vector view = kLocal ? load_vector(batch, kViewX, point) : Vector{zero, zero, splat(1.0f)};
      const Vector half{hn::Add(to_light.x, view.x), hn::Add(to_light.y, view.y),
                        hn::Add(to_light.z, view.z)};
      const Float n_dot_l = hn::Load(kFloat, light.n_dot_l + point);
      const Float n_dot_v = kLocal ? hn::Load(kFloat, batch.field[kNormalDotView] + point) : normal.z;
      if constexpr (kBlinn) {  // S = normalize(L + E)
        const Float squared = dot(half, half);
        const Float sum = hn::Add(n_dot_l, n_dot_v);
        if (HWY_LIKELY(uses_square)) {
          const Float not_negative = greater_of(sum, zero);
          base = hn::IfThenElseZero(hn::Gt(squared, zero),
                                    hn::Div(hn::Mul(not_negative, not_negative), squared));
        } else {
          const Float inverse = inverse_length(squared);
          base = is_sharp ? cosine_of_units(less_times(normal, half, inverse)) : hn::Mul(sum, inverse);
        }
      } else {  // R = 2 (L.n) n - L
        const Float twice = hn::Add(n_dot_l, n_dot_l);
        base = hn::Sub(hn::Mul(twice, n_dot_v), kLocal ? dot(to_light, view) : to_light.z);
        if (HWY_UNLIKELY(is_sharp)) base = cosine_of_units(less_times(half, normal, twice));  // E - R
      }
    }
    hn::Store(base, kFloat, light.highlight + point);
    any_shiny = hn::Or(any_shiny, is_shiny(floor, light, point));
  }
  return !hn::AllFalse(kFloat, any_shiny);
}

inline bool find_highlights(const LightTerm& term, const ShadingBatch& batch, int count, Incidence& light) {
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

}  // namespace HWY_NAMESPACE
}  // namespace tessera::detail
HWY_AFTER_NAMESPACE();

#endif
