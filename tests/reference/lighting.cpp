#include "lighting.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tessera::reference {
namespace {

Vec3 to_light(const EyeLight& light, Vec3 position) {
  return light.directional ? light.direction : normalize(light.position - position);
}

double attenuation(const EyeLight& light, Vec3 position) {
  constexpr double kUnbounded = 1e6;
  if (light.directional) return 1;
  const double d = length(light.position - position);
  const double denominator = light.attenuation[0] + light.attenuation[1] * d + light.attenuation[2] * d * d;
  return denominator <= 0 ? kUnbounded : 1 / denominator;
}

double spot(const EyeLight& light, Vec3 from_light) {
  if (!light.is_spot) return 1;
  const double along = dot(from_light, light.spot_direction);
  if (along < light.cos_cutoff || along <= 0) return 0;
  return std::pow(along, light.spot_exponent);
}

double highlight(const Surface& surface, const LightModel& model, Vec3 to_light) {
  const double facing = dot(to_light, surface.normal);
  if (facing <= 0) return 0;
  const Vec3 to_eye = model.local_viewer ? normalize(-surface.position) : Vec3{0, 0, 1};
  const double cosine = model.specular == SpecularModel::kBlinn
                            ? dot(normalize(to_light + to_eye), surface.normal)
                            : dot(2 * facing * surface.normal - to_light, to_eye);
  return std::pow(std::max(cosine, 0.0), surface.material.shininess);  // pow(0, 0) is 1
}

double luminance(Vec4 color) { return 0.30 * color.x + 0.59 * color.y + 0.11 * color.z; }

double clamp01(double x) { return x > 0 ? std::min(x, 1.0) : 0; }

}  // namespace

std::vector<EyeLight> lights_in_eye_space(const std::vector<Light>& lights, const Mat4& view_from_world) {
  std::vector<EyeLight> result;
  for (const Light& light : lights) {
    EyeLight eye;
    eye.ambient = light.ambient;
    eye.diffuse = light.diffuse;
    eye.specular = light.specular;
    eye.directional = light.position.w == 0;
    if (eye.directional) {
      eye.direction = normalize(transform_direction(view_from_world, xyz(light.position)));
    } else {
      const Vec4 p = transform(view_from_world, light.position);
      eye.position = {p.x / p.w, p.y / p.w, p.z / p.w};
    }
    eye.is_spot = light.spot_cutoff != 180;
    eye.spot_direction = normalize(transform_direction(view_from_world, light.spot_direction));
    eye.cos_cutoff = std::cos(light.spot_cutoff * std::numbers::pi / 180);
    eye.spot_exponent = light.spot_exponent;
    eye.attenuation = light.attenuation;
    result.push_back(eye);
  }
  return result;
}

Vec4 lit_color(const Surface& surface, const LightModel& model, const std::vector<EyeLight>& lights) {
  const Material& material = surface.material;
  Vec3 sum = xyz(material.emission) + xyz(model.ambient) * xyz(material.ambient);
  for (const EyeLight& light : lights) {
    const Vec3 l = to_light(light, surface.position);
    const double strength = attenuation(light, surface.position) * spot(light, -l);
    const Vec3 ambient = xyz(light.ambient) * xyz(material.ambient);
    const Vec3 diffuse = std::max(dot(l, surface.normal), 0.0) * (xyz(light.diffuse) * xyz(material.diffuse));
    const Vec3 specular = highlight(surface, model, l) * (xyz(light.specular) * xyz(material.specular));
    sum = sum + strength * (ambient + diffuse + specular);
  }
  return clamp01(Vec4{sum.x, sum.y, sum.z, material.diffuse.w});
}

double lit_index(const Surface& surface, const std::array<double, 3>& indexes, const LightModel& model,
                 const std::vector<EyeLight>& lights) {
  double d = 0;
  double s = 0;
  for (const EyeLight& light : lights) {
    const Vec3 l = to_light(light, surface.position);
    const double strength = attenuation(light, surface.position) * spot(light, -l);
    d += strength * std::max(dot(l, surface.normal), 0.0) * luminance(light.diffuse);
    s += strength * highlight(surface, model, l) * luminance(light.specular);
  }
  const auto [ambient, diffuse, specular] = indexes;
  return std::min(ambient + d * (1 - s) * (diffuse - ambient) + s * (specular - ambient), specular);
}

Vec4 clamp01(Vec4 c) { return {clamp01(c.x), clamp01(c.y), clamp01(c.z), clamp01(c.w)}; }

}  // namespace tessera::reference
