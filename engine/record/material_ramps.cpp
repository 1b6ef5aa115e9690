#include "engine/record/material_ramps.h"

#include <algorithm>
#include <utility>

#include "engine/record/checks.h"

namespace tessera::detail {

namespace {

RampColor operator+(const RampColor& x, const RampColor& y) { return {x.r + y.r, x.g + y.g, x.b + y.b}; }
RampColor operator*(double factor, const RampColor& c) { return {factor * c.r, factor * c.g, factor * c.b}; }

/// Light of a colour that a material of a colour reflects.
RampColor reflected(const Color& light, const Color& material) {
  return {double{light.r} * material.r, double{light.g} * material.g, double{light.b} * material.b};
}
RampColor plain(const Color& c) { return {c.r, c.g, c.b}; }

/// Contributions of a light: to a surface that faces it, and in the centre of its highlight.
struct LightTerms {
  RampColor diffuse, specular;
};

LightTerms light_terms(const Light& light, const Material& material) {
  // Attenuation is 1 / (constant + ...), so this is its largest value if the other factors are not negative.
  const double intensity = 1 / std::max(1.0, double{light.attenuation_constant});
  return {intensity * reflected(light.diffuse, material.diffuse),
          intensity * reflected(light.specular, material.specular)};
}

/// From ambient light over full diffuse light to the highlight.
ColorRamp ramp_of(const RampColor& ambient, const LightTerms& light) {
  ColorRamp corners{ambient};
  for (const RampColor& added : {light.diffuse, light.specular})
    if (!(added == RampColor{})) corners.push_back(corners.back() + added);
  return corners;
}

void append_ramps(const Material& material, const LitMaterials& group, std::vector<ColorRamp>& ramps) {
  RampColor ambient = plain(material.emission) + reflected(group.light_model.ambient, material.ambient);
  for (const Light& light : group.lights) ambient = ambient + reflected(light.ambient, material.ambient);
  LightTerms all;
  std::vector<ColorRamp> own;
  for (const Light& light : group.lights) {
    const LightTerms terms = light_terms(light, material);
    all = {all.diffuse + terms.diffuse, all.specular + terms.specular};
    own.push_back(ramp_of(ambient, terms));
  }
  own.push_back(ramp_of(ambient, all));
  for (ColorRamp& ramp : own)
    if (std::find(ramps.begin(), ramps.end(), ramp) == ramps.end()) ramps.push_back(std::move(ramp));
}

void check_group(const LitMaterials& group, const char* function) {
  for (const Material& m : group.materials)
    for (const Color& color : {m.ambient, m.diffuse, m.specular, m.emission})
      require_finite({function, ": a colour of a material"}, color);
  for (const Light& light : group.lights) {
    for (const Color& color : {light.ambient, light.diffuse, light.specular})
      require_finite({function, ": a colour of a light"}, color);
    require_finite({function, ": attenuation_constant"}, {light.attenuation_constant});
  }
  require_finite({function, ": the ambient light"}, group.light_model.ambient);
}

}  // namespace

void append_material_ramps(const LitMaterials& group, const char* function, std::vector<ColorRamp>& ramps) {
  check_group(group, function);
  for (const Material& material : group.materials) append_ramps(material, group, ramps);
}

}  // namespace tessera::detail
