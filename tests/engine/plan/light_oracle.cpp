#include "tests/engine/plan/light_oracle.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "tests/reference/primitives.h"
#include "tests/reference/rasterize_mesh.h"

namespace tessera::test {
namespace {

using namespace reference;

/// Angle of a cosine, 0 to 180 degrees.
double angle(double cosine) { return std::acos(std::clamp(cosine, -1.0, 1.0)) * 180 / std::numbers::pi; }

bool is_black(const Vec3& color) { return color.x == 0 && color.y == 0 && color.z == 0; }

/// Weighted sum of a member of the corners. The pixels of polygons may lie outside of them if only samples
/// are covered; their values stay within those of the corners.
Vec3 mixed(const Corners& corners, const CornerWeights& weights, Vec3 Corner::*member) {
  Vec3 sum, low = corners.all[0].*member, high = low;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const Vec3 value = corners.all[i].*member;
    sum = sum + weights[i] * value;
    low = {std::min(low.x, value.x), std::min(low.y, value.y), std::min(low.z, value.z)};
    high = {std::max(high.x, value.x), std::max(high.y, value.y), std::max(high.z, value.z)};
  }
  if (weights.size() < 3) return sum;
  return {std::clamp(sum.x, low.x, high.x), std::clamp(sum.y, low.y, high.y),
          std::clamp(sum.z, low.z, high.z)};
}

}  // namespace

LitPoints lit_points(const Scene& scene, const Draw& draw) {
  LitPoints points;
  const auto start = [&](const DrawnPrimitive& primitive) -> FragmentCallback {
    const Corners& corners = primitive.corners;
    const bool lights_back = primitive.is_back && scene.light_model.two_sided;
    const double side = lights_back ? -1 : 1;
    std::vector<LitPoint>& face = points.face[lights_back ? 1 : 0];
    if (draw.shading == Shading::kPhong)
      return [&corners, &face, side](const Fragment& fragment) {
        face.push_back({mixed(corners, fragment.weights, &Corner::position_eye),
                        side * normalize(mixed(corners, fragment.weights, &Corner::normal_eye))});
      };
    return [&corners, &face, &draw, side, is_first = true](const Fragment&) mutable {
      if (!is_first) return;
      is_first = false;
      const auto add = [&](const Corner& corner) {
        face.push_back({corner.position_eye, side * corner.normal_eye});
      };
      if (draw.shading == Shading::kFlat) add(corners.all[corners.provoking]);
      else std::for_each(corners.all.begin(), corners.all.end(), add);
    };
  };
  rasterize_mesh(scene.meshes.at(draw.mesh), draw, scene.camera, scene.framebuffer, start);
  return points;
}

LightOracle::LightOracle(const EyeLight& light, double cutoff_degrees, const Material& material,
                         const LightModel& model)
    : light_(light),
      cutoff_(cutoff_degrees),
      ambient_(xyz(light.ambient) * xyz(material.ambient)),
      diffuse_(xyz(light.diffuse) * xyz(material.diffuse)),
      specular_(xyz(light.specular) * xyz(material.specular)),
      shininess_(material.shininess),
      model_(model) {}

bool LightOracle::has_varying_ambient() const { return !light_.directional && !is_black(ambient_); }

LightAtPoint LightOracle::at(const LitPoint& point) const {
  LightAtPoint result;
  const Vec3 apart = light_.position - point.position;
  const Vec3 to_light = light_.directional ? light_.direction : normalize(apart);
  double strength = 1;  // attenuation and spot
  if (!light_.directional) {
    const double d = length(apart);
    const double denominator =
        light_.attenuation[0] + light_.attenuation[1] * d + light_.attenuation[2] * d * d;
    strength = denominator <= 0 ? 1e6 : 1 / denominator;
  }
  const double facing = dot(point.normal, to_light);
  const double n_length = std::sqrt(dot(point.normal, point.normal));
  if (n_length > 0 && !has_varying_ambient()) result.behind_by = angle(facing / n_length) - 90;
  if (light_.is_spot) {
    const double along = -dot(to_light, light_.spot_direction);
    result.outside_by = angle(along) - cutoff_;
    if (along < light_.cos_cutoff || along <= 0) return result;
    strength *= std::pow(along, light_.spot_exponent);
  }
  result.ambient = strength * ambient_;
  if (facing <= 0) return result;
  const Vec3 to_eye = model_.local_viewer ? normalize(-point.position) : Vec3{0, 0, 1};
  const double base = model_.specular == SpecularModel::kBlinn
                          ? dot(normalize(to_light + to_eye), point.normal)
                          : dot(2 * facing * point.normal - to_light, to_eye);
  // Finite also for long normals, so that its product with black is 0.
  const double highlight =
      std::min(std::pow(std::max(base, 0.0), shininess_), std::numeric_limits<double>::max());
  result.diffuse_and_specular = strength * (facing * diffuse_ + highlight * specular_);
  return result;
}

}  // namespace tessera::test
