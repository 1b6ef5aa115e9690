// Plans the lighting of a surface: its program holds only the terms that can contribute.
#include <algorithm>
#include <cmath>
#include <limits>

#include "framebuffer/format.h"
#include "framebuffer/trigonometry.h"
#include "shading/lighting.h"
#include "shading/power_reference.h"

namespace tessera::detail {
namespace {

std::array<float, 3> normalized(double x, double y, double z) {
  const double length = std::sqrt(x * x + y * y + z * z);
  if (length == 0) return {0, 0, 0};
  return {static_cast<float>(x / length), static_cast<float>(y / length), static_cast<float>(z / length)};
}

double dot(const std::array<float, 3>& a, const std::array<float, 3>& b) {
  return double{a[0]} * b[0] + double{a[1]} * b[1] + double{a[2]} * b[2];
}

/// Tolerance in radians: directions that leave a cone only because they were rounded to floats count as
/// inside, even for a cone of 0 degrees.
constexpr double kDirectionTolerance = 0x1p-22;
constexpr double kDirectionToleranceDegrees = kDirectionTolerance * 180 / 3.14159265358979323846;

/// The spot factor of a directional light, with V = -L: the same for all points.
float directional_spot_factor(const EyeLight& light) {
  const auto& l = light.position;
  const auto& d = light.spot_direction;
  // Rounded unit vectors differ from length 1 by more than the cosines of very narrow cones differ from 1.
  const double lengths = std::sqrt(dot(l, l) * dot(d, d));
  if (lengths == 0) return 0;
  const double cosine = std::min(-dot(l, d) / lengths, 1.0);
  if (cosine < sine_cosine(light.spot_cutoff + kDirectionToleranceDegrees).cosine || cosine <= 0) return 0;
  return power_of_reference(static_cast<float>(cosine), light.spot_exponent);
}

/// Largest squared distance between the axis of a cone and a unit vector inside the cone.
float squared_chord(float cutoff_degrees) {
  const double chord = 2 * sine_cosine(cutoff_degrees / 2.0).sine + kDirectionTolerance;
  return static_cast<float>(chord * chord);
}

/// Integer bits of the factor of a highlight: the product of its colours, times the largest attenuation.
/// Limited by the range of powers, which ends at 2^-126: a larger factor loses the foot of the highlight.
float bits_above_one(const LightTerm& term) {
  constexpr double kMaxBits = 94;
  if (!is_black(term.tracked_specular)) return kMaxBits;  // vertex colours are unbounded
  double largest =
      std::max({std::abs(term.specular[0]), std::abs(term.specular[1]), std::abs(term.specular[2])});
  if (term.kind == LightKind::attenuated_point || term.kind == LightKind::attenuated_spot) {
    const auto [constant, linear, quadratic] = term.attenuation;
    const bool denominator_may_be_tiny = !(constant > 0 && linear >= 0 && quadratic >= 0);
    if (denominator_may_be_tiny) return kMaxBits;
    largest /= constant;
  }
  return largest > 1 ? static_cast<float>(std::min(std::ilogb(largest) + 1.0, kMaxBits)) : 0.0f;
}

EffectReason reason_of(HighlightKind kind) {
  switch (kind) {
    case HighlightKind::none: return EffectReason::black_specular;
    case HighlightKind::blinn_infinite: return EffectReason::blinn_infinite_viewer;
    case HighlightKind::blinn_local: return EffectReason::blinn_local_viewer;
    case HighlightKind::phong_infinite: return EffectReason::phong_infinite_viewer;
    case HighlightKind::phong_local: return EffectReason::phong_local_viewer;
  }
  return EffectReason::requested;
}

LightKind kind_of(const EyeLight& light) {
  if (light.directional) return LightKind::directional;
  const bool attenuated =
      !(light.attenuation[0] == 1 && light.attenuation[1] == 0 && light.attenuation[2] == 0);
  if (light.spot_cutoff == 180) return attenuated ? LightKind::attenuated_point : LightKind::point;
  return attenuated ? LightKind::attenuated_spot : LightKind::spot;
}

bool has_ambient(const LightTerm& term) { return !is_black(term.ambient) || !is_black(term.tracked_ambient); }
bool has_diffuse(const LightTerm& term) { return !is_black(term.diffuse) || !is_black(term.tracked_diffuse); }
bool has_specular(const LightTerm& term) {
  return !is_black(term.specular) || !is_black(term.tracked_specular);
}

void note_term(const EffectNotes& notes, const LightTerm& term, int light, const LightingModel& model) {
  const auto note = [&](Effect effect, bool active, EffectReason reason, std::string_view cause = {}) {
    notes.add({.effect = effect, .active = active, .reason = reason, .light = light, .cause = cause});
  };
  const bool directional = term.kind == LightKind::directional;
  note(Effect::light, true, directional ? EffectReason::directional : EffectReason::positional);
  if (!directional) {
    const bool attenuated =
        term.kind == LightKind::attenuated_point || term.kind == LightKind::attenuated_spot;
    note(Effect::light_attenuation, attenuated,
         attenuated ? EffectReason::requested : EffectReason::unit_attenuation);
    note(Effect::light_spot, is_spot(term.kind),
         is_spot(term.kind) ? EffectReason::requested : EffectReason::cutoff_180);
  }
  const bool has_highlight = term.highlight != HighlightKind::none;
  note(Effect::light_highlight, has_highlight, reason_of(term.highlight),
       has_highlight && model.viewer_is_capped ? "quality.viewer" : "");
  if (has_ambient(term)) note(Effect::light_ambient, true, EffectReason::requested);
  if (!is_black(term.tracked_diffuse) || !is_black(term.tracked_specular))
    note(Effect::light_tracked_colors, true, EffectReason::requested);
}

/// Products beyond the range of floats become the largest float, so that 0 times them is 0.
Rgb finite(Rgb color) {
  for (float& component : color) component = std::clamp(component, -kMaxFloat, kMaxFloat);
  return color;
}

EyeLight unchanged(const EyeLight& light) { return light; }
EyeLight to_luminance(const EyeLight& light) {
  const auto grey = [](const Rgb& c) {
    const float luminance = std::fma(kLumaR, c[0], std::fma(kLumaG, c[1], kLumaB * c[2]));
    return Rgb{luminance, luminance, luminance};
  };
  EyeLight changed = light;
  changed.ambient = {};
  changed.diffuse = grey(light.diffuse);
  changed.specular = grey(light.specular);
  return changed;
}

/// Folds the colours of the light and the material, and the cone of a directional light.
void fold_colors(LightTerm& term, const EyeLight& light, const SurfaceMaterial& material,
                 const TrackedColors& tracked) {
  const float factor = light.directional && light.spot_cutoff != 180 ? directional_spot_factor(light) : 1.0f;
  const auto fold = [factor](bool is_tracked, const Rgb& of_light, const Rgb& of_material, Rgb& product,
                             Rgb& tracked_product) {
    if (is_tracked) tracked_product = finite(of_light * factor);
    else product = finite(finite(of_light * of_material) * factor);
  };
  fold(tracked.ambient, light.ambient, material.ambient, term.ambient, term.tracked_ambient);
  fold(tracked.diffuse, light.diffuse, material.diffuse, term.diffuse, term.tracked_diffuse);
  fold(tracked.specular, light.specular, material.specular, term.specular, term.tracked_specular);
}

HighlightKind highlight_kind(const LightingModel& model) {
  if (model.phong_highlight)
    return model.local_viewer ? HighlightKind::phong_local : HighlightKind::phong_infinite;
  return model.local_viewer ? HighlightKind::blinn_local : HighlightKind::blinn_infinite;
}

/// Sets the position, attenuation and cone. @pre `term` has its kind
void set_light(LightTerm& term, const EyeLight& light) {
  term.position = light.position;
  term.half_vector = normalized(light.position[0], light.position[1], double{light.position[2]} + 1);
  term.spot_direction = light.spot_direction;
  term.attenuation = light.attenuation;
  term.spot_power = make_power(light.spot_exponent);
  term.spot_cosine = static_cast<float>(sine_cosine(light.spot_cutoff).cosine);
  if (is_spot(term.kind) && light.spot_cutoff < kNarrowCone)
    term.spot_chord_squared = squared_chord(light.spot_cutoff);
}

/// Decides how the highlight is computed, and which bases make none.
/// @pre `term` has its kinds, colours and attenuation
void set_highlight(LightTerm& term, const LightingModel& model, float shininess) {
  const bool has_highlight = term.highlight != HighlightKind::none;
  term.sharp = has_highlight && model.unit_normals && shininess > kSharpShininess;
  const bool half_varies =
      term.highlight == HighlightKind::blinn_local ||
      (term.highlight == HighlightKind::blinn_infinite && term.kind != LightKind::directional);
  // Powers below 2^-visible_bits are invisible.
  const float visible_bits = 32 + bits_above_one(term);
  // Squares are at least 2^-126, so cosines whose squares are used are at least 2^-63.
  const bool may_square = half_varies && 63 * shininess >= visible_bits;
  term.squared = may_square && model.unit_normals && !term.sharp;
  const float exponent = term.squared ? shininess / 2 : shininess;
  term.highlight_power = make_power(exponent);
  // x^s < 2^-b if x < 2^(-b / s): holds for most of a shiny surface, which then needs no power.
  term.highlight_floor = exponent == 0 ? std::numeric_limits<float>::quiet_NaN()
                                       : exp2_reference(std::max(-visible_bits / exponent, -126.0f));
}

/// The field that makes the products of a light and a material black. Empty: the light's colours.
std::string_view cause_of_black(const EyeLight& light) {
  const bool has_cone = light.directional && light.spot_cutoff != 180;
  if (has_cone && directional_spot_factor(light) == 0) return ".spot_cutoff";
  return is_black(light.diffuse) && is_black(light.specular) ? "" : "material.diffuse";
}

/// Adds the term of one light to the program, unless it cannot contribute or is constant.
/// @param number  number of the light, for notes
void plan_term(LightingProgram& program, const EyeLight& light, int number, LightReach reach,
               const SurfaceMaterial& material, const TrackedColors& tracked, const LightingModel& model,
               const EffectNotes& notes) {
  const auto note_skipped = [&](EffectReason reason, std::string_view cause = {}) {
    notes.add({.effect = Effect::light, .active = false, .reason = reason, .light = number, .cause = cause});
  };
  LightTerm term;
  fold_colors(term, light, material, tracked);
  const bool has_only_ambient = !has_diffuse(term) && !has_specular(term);
  if (has_only_ambient && !has_ambient(term)) return note_skipped(EffectReason::black, cause_of_black(light));
  term.kind = kind_of(light);
  // The ambient term of a directional light is constant.
  if (term.kind == LightKind::directional) {
    program.base = program.base + term.ambient;
    program.tracked_base = program.tracked_base + term.tracked_ambient;
    term.ambient = term.tracked_ambient = {};
    if (has_only_ambient) return note_skipped(EffectReason::constant_ambient);
  }
  if (reach == LightReach::below_threshold)
    return note_skipped(EffectReason::below_threshold, "quality.light_threshold");
  if (reach == LightReach::outside_cone) return note_skipped(EffectReason::light_outside_cone);
  if (reach == LightReach::behind && !has_ambient(term)) return note_skipped(EffectReason::light_behind);
  if (has_specular(term)) term.highlight = highlight_kind(model);
  set_light(term, light);
  set_highlight(term, model, material.shininess);
  program.needs_normal = true;
  program.needs_position |= term.kind != LightKind::directional;
  program.needs_view |=
      term.highlight == HighlightKind::blinn_local || term.highlight == HighlightKind::phong_local;
  note_term(notes, term, number, model);
  program.terms.push_back(term);
}

/// @param convert  applied to each light: unchanged() or to_luminance()
LightingProgram plan_terms(const SurfaceMaterial& material, const TrackedColors& tracked,
                           const std::vector<EyeLight>& lights, EyeLight (&convert)(const EyeLight&),
                           const LightingModel& model, const EffectNotes& notes,
                           std::vector<LightTerm> term_storage, std::span<const LightReach> reach) {
  LightingProgram program;
  program.terms = std::move(term_storage);
  program.terms.clear();
  program.tracked = tracked.any();
  const Rgb white{1, 1, 1};
  if (tracked.emission) program.tracked_base = program.tracked_base + white;
  if (tracked.ambient) program.tracked_base = program.tracked_base + model.scene_ambient;
  if (!tracked.emission) program.base = program.base + material.emission;
  if (!tracked.ambient) program.base = program.base + model.scene_ambient * material.ambient;
  for (std::size_t number = 0; number < lights.size(); ++number)
    plan_term(program, convert(lights[number]), static_cast<int>(number),
              reach.empty() ? LightReach::unknown : reach[number], material, tracked, model, notes);
  program.needs_position |= program.needs_view;
  return program;
}

}  // namespace

LightingProgram plan_lighting(const SurfaceMaterial& material, const TrackedColors& tracked,
                              const std::vector<EyeLight>& lights, const LightingModel& model,
                              const EffectNotes& notes, std::vector<LightTerm> term_storage,
                              std::span<const LightReach> reach) {
  return plan_terms(material, tracked, lights, unchanged, model, notes, std::move(term_storage), reach);
}

LightingProgram plan_index_lighting(const IndexMaterial& material, const std::vector<EyeLight>& lights,
                                    const LightingModel& model, const EffectNotes& notes,
                                    std::vector<LightTerm> term_storage, std::span<const LightReach> reach) {
  const auto [ambient, diffuse, specular] = material.indexes;
  // Red sums d, green sums s, which also scales the diffuse ramp. Ramps between equal indices need no term.
  SurfaceMaterial surface{
      .ambient = {}, .diffuse = {}, .specular = {}, .emission = {}, .shininess = material.shininess};
  if (diffuse != ambient) surface.diffuse = {1, 0, 0};
  if (diffuse != ambient || specular != ambient) surface.specular = {0, 1, 0};
  LightingModel dark = model;
  dark.scene_ambient = {};
  LightingProgram program =
      plan_terms(surface, {}, lights, to_luminance, dark, notes, std::move(term_storage), reach);
  program.index = true;
  program.indexes = material.indexes;
  program.index_modulus = material.modulus;
  return program;
}

}  // namespace tessera::detail
