// Kernel of the lighting equation: sums the terms of all lights over a batch of points.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shading/lighting.cpp"
#include "framebuffer/lanes.h"

#include "shading/light_terms-inl.h"
#include "shading/lighting.h"

HWY_BEFORE_NAMESPACE();
namespace tessera::detail {
namespace HWY_NAMESPACE {

/// sum += intensity * colour
HWY_INLINE void accumulate(Vector& sum, Float intensity, const Vector& color) {
  sum.x = mul_add(intensity, color.x, sum.x);
  sum.y = mul_add(intensity, color.y, sum.y);
  sum.z = mul_add(intensity, color.z, sum.z);
}

/// An RGB sum per point, stored in the batch once the first light has been added.
struct Sums {
  BatchField first_field;  // field of red
  Rgb start;               // sum of all points before the first light
  bool begun = false;      // the fields hold the sums

  HWY_INLINE Vector load(const ShadingBatch& batch, int point) const {
    return begun ? load_vector(batch, first_field, point) : splat_vector(start);
  }
};

/// Adds the diffuse and, if given, the specular term of a light to a chunk of points.
/// @param highlight  spec * att * spot; may be omitted
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

/// Adds the diffuse and specular terms of a light to all points.
void add_colors(const LightTerm& term, bool has_tracked, bool has_highlights, int count,
                const Incidence& light, Sums& color, Sums& tracked, ShadingBatch& batch) {
  // Loaded before the loops, as in find_incidence().
  const Vector diffuse = splat_vector(term.diffuse);
  const Vector specular = splat_vector(term.specular);
  const Float floor = splat(term.highlight_floor);
  const auto add = [=, &term, &light, &batch](int point, auto... highlight) HWY_ATTR {
    add_products(light, point, diffuse, specular, color, batch, highlight...);
    if (has_tracked)
      add_products(light, point, splat_vector(term.tracked_diffuse), splat_vector(term.tracked_specular),
                   tracked, batch, highlight...);
  };
  if (has_highlights) {
    const auto add_with_highlight = [&light, add, floor](int point, Float power) HWY_ATTR {
      const Float highlight = clamp_finite(hn::Mul(power, hn::Load(kFloat, light.factor + point)));
      add(point, hn::IfThenElseZero(is_shiny(floor, light, point), highlight));
    };
    for_each_power(term.highlight_power, light.highlight, count, add_with_highlight);
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

/// Adds all terms of a light to the sums.
void add_light(const LightTerm& term, bool has_tracked, int count, Sums& color, Sums& tracked,
               ShadingBatch& batch) {
  const bool has_ambient = !is_black(term.ambient) || !is_black(term.tracked_ambient);
  Incidence light;
  const bool any_facing = find_incidence(term, batch, count, light);
  if (!any_facing && !has_ambient) return;  // the light adds exact zeros only
  if (is_spot(term.kind) && term.spot_power.exponent != 0) apply_cone(term, count, light);
  if (has_ambient) {
    add_ambient(light, count, term.ambient, color, batch);
    if (has_tracked) add_ambient(light, count, term.tracked_ambient, tracked, batch);
  }
  if (!any_facing) return;
  const bool has_highlights = find_highlights(term, batch, count, light);
  add_colors(term, has_tracked, has_highlights, count, light, color, tracked, batch);
}

/// Clamps to finite numbers, so that a product with 0 is 0. A NaN becomes the lowest number.
HWY_INLINE Float finite(Float c) { return lesser_of(greater_of(c, splat(-kMaxFloat)), splat(kMaxFloat)); }
/// Clamps to 0..1. A NaN becomes 0.
HWY_INLINE Float clamped(Float c) { return lesser_of(greater_of(c, hn::Zero(kFloat)), splat(1.0f)); }

/// Normalizes the normals, negates those of back faces, and computes the direction to the viewer.
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

/// index = min(a + d (1 - s) (dm - a) + s (sm - a), sm), masked, with d in red and s in green; a, dm and sm
/// are the ambient, diffuse and specular index.
HWY_INLINE Float index_of(const LightingProgram& program, const Vector& sums) {
  const auto [ambient, diffuse, specular] = program.indexes;
  const Float d = finite(sums.x);
  const Float s = finite(sums.y);
  const Float without_highlight =
      mul_add(hn::Mul(d, hn::Sub(splat(1.0f), s)), splat(diffuse - ambient), splat(ambient));
  const Float index = lesser_of(mul_add(s, splat(specular - ambient), without_highlight), splat(specular));
  const Float turns = hn::Floor(hn::Mul(index, splat(1 / program.index_modulus)));
  const Float masked = hn::Sub(index, hn::Mul(splat(program.index_modulus), turns));
  return hn::IfThenElseZero(hn::Ge(masked, hn::Zero(kFloat)), masked);
}

void light_points_lanes(const LightingProgram& program, ShadingBatch& batch, int count) {
  const bool changes_normals = program.renormalize || program.negate_normal;
  if (program.needs_normal && (changes_normals || program.needs_view))
    prepare_surfaces(program, batch, count);
  Sums color{kColorR, program.base};
  Sums tracked{kTrackedR, program.tracked_base};
  for (const LightTerm& term : program.terms) add_light(term, program.tracked, count, color, tracked, batch);
  for (int point = 0; point < count; point += kLanes) {
    Vector sum = color.load(batch, point);
    if (program.index) {
      hn::Store(index_of(program, sum), kFloat, batch.field[kColorR] + point);
      continue;
    }
    if (program.tracked) {
      const Vector factor = tracked.load(batch, point);
      const Vector vertex = load_vector(batch, kVertexR, point);
      sum = {mul_add(finite(factor.x), finite(vertex.x), sum.x),
             mul_add(finite(factor.y), finite(vertex.y), sum.y),
             mul_add(finite(factor.z), finite(vertex.z), sum.z)};
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
