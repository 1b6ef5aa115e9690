// Kernels of the lighting equation: one for each kind of light and highlight, chosen once a batch.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shading/lighting.cpp"
#include "framebuffer/lanes.h"

#include <array>

#include "shading/lighting.h"
#include "shading/power-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tessera {
namespace HWY_NAMESPACE {

struct Vector {
  Float x, y, z;
};
HWY_INLINE Float dot(const Vector& a, const Vector& b) { return mul_add(a.x, b.x, mul_add(a.y, b.y, hn::Mul(a.z, b.z))); }
/// a - b s
HWY_INLINE Vector less_times(const Vector& a, const Vector& b, Float s) { return {neg_mul_add(b.x, s, a.x), neg_mul_add(b.y, s, a.y), neg_mul_add(b.z, s, a.z)}; }
/// The cosine of two unit vectors that are that far apart: near 1 it has the error of what is missing there.
HWY_INLINE Float cosine_of_units(const Vector& apart) { return mul_add(splat(-0.5f), dot(apart, apart), splat(1.0f)); }
HWY_INLINE Vector splat_vector(const std::array<float, 3>& v) { return {splat(v[0]), splat(v[1]), splat(v[2])}; }
HWY_INLINE Vector load_vector(const ShadingBatch& batch, int first_field, int point) {
  return {hn::Load(kFloat, batch.field[first_field] + point), hn::Load(kFloat, batch.field[first_field + 1] + point),
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
HWY_INLINE Float power_or_one(Float x, float exponent) { return exponent == 0 ? splat(1.0f) : power_lanes(x, exponent); }
/// sum += intensity * colour
HWY_INLINE void accumulate(Vector& sum, Float intensity, const Rgb& color) {
  sum.x = mul_add(intensity, splat(color[0]), sum.x);
  sum.y = mul_add(intensity, splat(color[1]), sum.y);
  sum.z = mul_add(intensity, splat(color[2]), sum.z);
}

/// What is known of one chunk of points: unit normals on the side that is lit, and the direction to a local viewer.
struct Surface {
  Vector normal, view;
  Float n_dot_v;
};
/// The sums of one chunk of points: colour, and what the vertex colour multiplies.
struct Sums {
  Vector color, tracked;
};

/// Adds one light to a chunk of points.
template <LightKind kKind, HighlightKind kHighlight, bool kGeneral>
HWY_INLINE void add_light_to_chunk(const LightTerm& term, const ShadingBatch& batch, int point, const Surface& surface, Sums& sums) {
  constexpr bool kPositional = kKind != LightKind::directional;
  constexpr bool kSpot = kKind == LightKind::spot || kKind == LightKind::attenuated_spot;
  constexpr bool kAttenuated = kKind == LightKind::attenuated_point || kKind == LightKind::attenuated_spot;
  constexpr bool kBlinn = kHighlight == HighlightKind::blinn_infinite || kHighlight == HighlightKind::blinn_local;
  constexpr bool kLocal = kHighlight == HighlightKind::blinn_local || kHighlight == HighlightKind::phong_local;
  const Float zero = hn::Zero(kFloat);
  const Vector& normal = surface.normal;
  Vector to_light = splat_vector(term.position);
  Float factor = splat(1.0f);  // att * spot
  auto reached = hn::Eq(zero, zero);
  if constexpr (kPositional) {
    const Vector position = load_vector(batch, kPositionX, point);
    to_light = {hn::Sub(to_light.x, position.x), hn::Sub(to_light.y, position.y), hn::Sub(to_light.z, position.z)};
    const Float squared = dot(to_light, to_light);
    const Float distance = hn::Sqrt(squared);
    const Float inverse = hn::IfThenElseZero(hn::Gt(squared, zero), hn::Div(splat(1.0f), distance));
    to_light = {hn::Mul(to_light.x, inverse), hn::Mul(to_light.y, inverse), hn::Mul(to_light.z, inverse)};
    if constexpr (kSpot) {
      const Float cosine = hn::Sub(zero, dot(to_light, splat_vector(term.spot_direction)));
      reached = hn::And(hn::Ge(cosine, splat(term.spot_cosine)), hn::Gt(cosine, zero));
      if (hn::AllFalse(kFloat, reached)) return;
      factor = hn::IfThenElseZero(reached, power_or_one(cosine, term.spot_exponent));
    }
    if constexpr (kAttenuated) {
      const Float denominator =
          mul_add(splat(term.attenuation[2]), squared, mul_add(splat(term.attenuation[1]), distance, splat(term.attenuation[0])));
      const auto valid = hn::Gt(denominator, zero);
      factor = hn::Mul(factor, hn::IfThenElse(valid, hn::Div(splat(1.0f), denominator), splat(1.0e6f)));
    }
  }
  const Float n_dot_l = dot(normal, to_light);
  const auto facing = hn::And(hn::Gt(n_dot_l, zero), reached);
  if (!kGeneral && hn::AllFalse(kFloat, facing)) return;  // adds exact zeros only

  const Float diffuse = hn::IfThenElseZero(facing, hn::Mul(n_dot_l, factor));
  Float highlight = zero;
  if constexpr (kHighlight != HighlightKind::none) {
    Float base;
    if constexpr (kBlinn && !kLocal && !kPositional) {
      const Vector half = splat_vector(term.half_vector);
      base = dot(normal, half);
      if (kGeneral && HWY_UNLIKELY(term.sharp)) base = cosine_of_units(less_times(normal, half, splat(1.0f)));
    } else {
      const Vector view = kLocal ? surface.view : Vector{zero, zero, splat(1.0f)};
      const Float n_dot_v = kLocal ? surface.n_dot_v : normal.z;
      if constexpr (kBlinn) {  // S = normalize(L + E)
        const Vector half{hn::Add(to_light.x, view.x), hn::Add(to_light.y, view.y), hn::Add(to_light.z, view.z)};
        const Float inverse = inverse_length(dot(half, half));
        base = hn::Mul(hn::Add(n_dot_l, n_dot_v), inverse);
        if (kGeneral && HWY_UNLIKELY(term.sharp)) base = cosine_of_units(less_times(normal, half, inverse));
      } else {  // R = 2 (L.n) n - L
        const Float twice = hn::Add(n_dot_l, n_dot_l);
        base = hn::Sub(hn::Mul(twice, n_dot_v), kLocal ? dot(to_light, view) : to_light.z);
        if (kGeneral && HWY_UNLIKELY(term.sharp))  // E - R
          base = cosine_of_units(less_times({hn::Add(to_light.x, view.x), hn::Add(to_light.y, view.y), hn::Add(to_light.z, view.z)}, normal, twice));
      }
    }
    const auto shiny = hn::And(facing, hn::Gt(base, splat(term.highlight_floor)));
    if (!hn::AllFalse(kFloat, shiny)) highlight = hn::IfThenElseZero(shiny, hn::Mul(power_or_one(base, term.shininess), factor));
  }

  if constexpr (kGeneral) accumulate(sums.color, factor, term.ambient);
  accumulate(sums.color, diffuse, term.diffuse);
  if constexpr (kHighlight != HighlightKind::none) accumulate(sums.color, highlight, term.specular);
  if constexpr (kGeneral) {
    accumulate(sums.tracked, factor, term.tracked_ambient);
    accumulate(sums.tracked, diffuse, term.tracked_diffuse);
    if constexpr (kHighlight != HighlightKind::none) accumulate(sums.tracked, highlight, term.tracked_specular);
  }
}

/// Normals to length 1 and to the side that is lit, and the direction to the viewer.
HWY_INLINE Surface prepare_surface(const LightingProgram& program, const ShadingBatch& batch, int point) {
  const Float zero = hn::Zero(kFloat);
  Surface surface{load_vector(batch, kNormalX, point), {zero, zero, zero}, zero};
  Vector& normal = surface.normal;
  Float scale = program.renormalize ? inverse_length(dot(normal, normal)) : splat(1.0f);
  if (program.negate_normal) scale = hn::Sub(zero, scale);
  normal = {hn::Mul(normal.x, scale), hn::Mul(normal.y, scale), hn::Mul(normal.z, scale)};
  if (program.needs_view) {
    const Vector position = load_vector(batch, kPositionX, point);
    const Float away = hn::Sub(zero, inverse_length(dot(position, position)));
    surface.view = {hn::Mul(position.x, away), hn::Mul(position.y, away), hn::Mul(position.z, away)};
    surface.n_dot_v = dot(normal, surface.view);
  }
  return surface;
}

/// 0..1; a NaN, which only overflow can make, becomes 0.
HWY_INLINE Float clamped(Float c) {
  const Float zero = hn::Zero(kFloat), one = splat(1.0f);
  return lesser_of(greater_of(c, zero), one);
}
HWY_INLINE Vector clamped(const Vector& c) { return {clamped(c.x), clamped(c.y), clamped(c.z)}; }

/// One light of several: surfaces and sums stand in the batch.
template <LightKind kKind, HighlightKind kHighlight, bool kGeneral>
void add_light(const LightTerm& term, ShadingBatch& batch, int count) {
  constexpr bool kLocal = kHighlight == HighlightKind::blinn_local || kHighlight == HighlightKind::phong_local;
  for (int point = 0; point < count; point += kLanes) {
    Surface surface{load_vector(batch, kNormalX, point), {}, {}};
    if constexpr (kLocal) surface.view = load_vector(batch, kViewX, point), surface.n_dot_v = hn::Load(kFloat, batch.field[kNormalDotView] + point);
    Sums sums{load_vector(batch, kColorR, point), {}};
    if constexpr (kGeneral) sums.tracked = load_vector(batch, kTrackedR, point);
    add_light_to_chunk<kKind, kHighlight, kGeneral>(term, batch, point, surface, sums);
    store_vector(batch, kColorR, point, sums.color);
    if constexpr (kGeneral) store_vector(batch, kTrackedR, point, sums.tracked);
  }
}

/// The whole program of a surface under a single light, which most have: nothing goes through memory in between.
template <LightKind kKind, HighlightKind kHighlight>
void light_alone(const LightingProgram& program, ShadingBatch& batch, int count) {
  const LightTerm& term = program.terms.front();
  for (int point = 0; point < count; point += kLanes) {
    Sums sums{splat_vector(program.base), {}};
    add_light_to_chunk<kKind, kHighlight, false>(term, batch, point, prepare_surface(program, batch, point), sums);
    store_vector(batch, kColorR, point, clamped(sums.color));
  }
}

struct LightKernels {
  void (*add)(const LightTerm&, ShadingBatch&, int);
  void (*alone)(const LightingProgram&, ShadingBatch&, int);  // of lights that are not general
};

template <LightKind kKind, HighlightKind kHighlight>
LightKernels light_kernels(bool general) {
  return {general ? &add_light<kKind, kHighlight, true> : &add_light<kKind, kHighlight, false>, &light_alone<kKind, kHighlight>};
}
template <LightKind kKind>
LightKernels light_kernels(HighlightKind highlight, bool general) {
  switch (highlight) {
    case HighlightKind::none: return light_kernels<kKind, HighlightKind::none>(general);
    case HighlightKind::blinn_infinite: return light_kernels<kKind, HighlightKind::blinn_infinite>(general);
    case HighlightKind::blinn_local: return light_kernels<kKind, HighlightKind::blinn_local>(general);
    case HighlightKind::phong_infinite: return light_kernels<kKind, HighlightKind::phong_infinite>(general);
    default: return light_kernels<kKind, HighlightKind::phong_local>(general);
  }
}
LightKernels light_kernels(const LightTerm& term) {
  const bool general = term.general || term.sharp;
  switch (term.kind) {
    case LightKind::directional: return light_kernels<LightKind::directional>(term.highlight, general);
    case LightKind::point: return light_kernels<LightKind::point>(term.highlight, general);
    case LightKind::attenuated_point: return light_kernels<LightKind::attenuated_point>(term.highlight, general);
    case LightKind::spot: return light_kernels<LightKind::spot>(term.highlight, general);
    default: return light_kernels<LightKind::attenuated_spot>(term.highlight, general);
  }
}

/// Surfaces, and the terms that no light has a part in.
void prepare_points(const LightingProgram& program, ShadingBatch& batch, int count) {
  for (int point = 0; point < count; point += kLanes) {
    if (program.needs_normal && (program.renormalize || program.negate_normal || program.needs_view)) {
      const Surface surface = prepare_surface(program, batch, point);
      store_vector(batch, kNormalX, point, surface.normal);
      if (program.needs_view) {
        store_vector(batch, kViewX, point, surface.view);
        hn::Store(surface.n_dot_v, kFloat, batch.field[kNormalDotView] + point);
      }
    }
    store_vector(batch, kColorR, point, splat_vector(program.base));
    if (program.tracked) store_vector(batch, kTrackedR, point, splat_vector(program.tracked_base));
  }
}

/// index = min(a + d (1 - s) (dm - a) + s (sm - a), sm), masked, from d in red and s in green.
void store_indices(const LightingProgram& program, ShadingBatch& batch, int count) {
  const auto [ambient, diffuse, specular] = program.indexes;
  const Float zero = hn::Zero(kFloat), most = splat(specular), modulus = splat(program.index_modulus), inverse = splat(1 / program.index_modulus);
  for (int point = 0; point < count; point += kLanes) {
    const Float d = hn::Load(kFloat, batch.field[kColorR] + point), s = hn::Load(kFloat, batch.field[kColorG] + point);
    const Float matt = mul_add(hn::Mul(d, hn::Sub(splat(1.0f), s)), splat(diffuse - ambient), splat(ambient));
    const Float sum = mul_add(s, splat(specular - ambient), matt);
    const Float index = lesser_of(sum, most);
    const Float rest = hn::Sub(index, hn::Mul(modulus, hn::Floor(hn::Mul(index, inverse))));
    hn::Store(hn::IfThenElseZero(hn::Ge(rest, zero), rest), kFloat, batch.field[kColorR] + point);
  }
}

void light_points_lanes(const LightingProgram& program, ShadingBatch& batch, int count) {
  if (program.terms.size() == 1 && !program.tracked && !program.index && !program.terms.front().general && !program.terms.front().sharp) return light_kernels(program.terms.front()).alone(program, batch, count);
  prepare_points(program, batch, count);
  for (const LightTerm& term : program.terms) light_kernels(term).add(term, batch, count);
  if (program.index) return store_indices(program, batch, count);
  for (int point = 0; point < count; point += kLanes) {
    Vector color = load_vector(batch, kColorR, point);
    if (program.tracked) {
      const Vector tracked = load_vector(batch, kTrackedR, point), vertex = load_vector(batch, kVertexR, point);
      color = {mul_add(tracked.x, vertex.x, color.x), mul_add(tracked.y, vertex.y, color.y), mul_add(tracked.z, vertex.z, color.z)};
    }
    store_vector(batch, kColorR, point, clamped(color));
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tessera {

LightPoints* light_points(Isa isa) { return TESSERA_KERNEL(isa, light_points_lanes); }

}  // namespace tessera
#endif
