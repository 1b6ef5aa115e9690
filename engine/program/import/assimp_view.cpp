#include "engine/program/import/assimp_view.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include <assimp/matrix3x3.h>

#include "engine/program/import/spot_exponent.h"
#include "engine/tessera/tessera.hpp"

namespace tessera::program {
namespace {

constexpr double kStandardFovy = 45;  // degrees

double tangent(double degrees) {
  const SinCos at = sin_cos_degrees(degrees);
  return at.sine / at.cosine;
}

// Sets the angle of view; returns false if the file gives no valid one. mHorizontalFOV is the full angle in
// radians, although assimp's header documents it as the half angle.
bool set_angle(const aiCamera& camera, bool is_collada, ModelCamera& to) {
  const bool has_aspect = camera.mAspect > 0;
  if (is_collada && !has_aspect) {  // the file gives no angle; assimp's value is meaningless
    to.half_height = tangent(kStandardFovy / 2);
    return true;
  }
  const double degrees = camera.mHorizontalFOV * kDegreesPerRadian;
  if (!(degrees > 0.01 && degrees < 179)) return false;
  to.half_width = tangent(degrees / 2);
  if (has_aspect) to.half_height = std::exchange(to.half_width, 0) / camera.mAspect;
  return true;
}

void set_attenuation(const aiLight& light, bool is_collada, Light& to) {
  const float constant = std::max(light.mAttenuationConstant, 1.0f);
  const float linear = light.mAttenuationLinear;
  const float quadratic = light.mAttenuationQuadratic;
  const bool is_assimp_default = linear == 1 && quadratic == 0;
  const bool is_given = is_collada || !is_assimp_default;
  const bool is_valid = linear >= 0 && quadratic >= 0 && std::isfinite(constant + linear + quadratic);
  if (!is_given || !is_valid) return;
  to.attenuation_constant = constant;
  to.attenuation_linear = linear;
  to.attenuation_quadratic = quadratic;
}

}  // namespace

std::optional<ModelCamera> camera_of(const aiCamera& camera, const aiMatrix4x4& world, bool is_collada) {
  const aiVector3D eye = world * camera.mPosition;
  const aiVector3D target = world * (camera.mPosition + camera.mLookAt);
  const aiVector3D up = aiMatrix3x3(world) * camera.mUp;
  ModelCamera to{.near = camera.mClipPlaneNear, .far = camera.mClipPlaneFar};
  to.is_orthographic = camera.mOrthographicWidth > 0 && std::isfinite(camera.mOrthographicWidth);
  if (to.is_orthographic) {
    if (camera.mAspect > 0) to.half_height = camera.mOrthographicWidth / camera.mAspect;
    else to.half_width = camera.mOrthographicWidth;
  } else if (!set_angle(camera, is_collada, to)) {
    return {};
  }
  try {
    to.view = look_at({eye.x, eye.y, eye.z}, {target.x, target.y, target.z}, {up.x, up.y, up.z});
  } catch (const Error&) {
    return {};
  }
  return to;
}

void add_light(const aiLight& light, const aiMatrix4x4& world, bool is_collada, Model& model) {
  const aiColor3D& given = light.mType == aiLightSource_AMBIENT ? light.mColorAmbient : light.mColorDiffuse;
  const float unit = 1 / std::max({given.r, given.g, given.b, 1.0f});
  const Color c{given.r * unit, given.g * unit, given.b * unit, 1};
  if (!std::isfinite(c.r + c.g + c.b) || (c.r <= 0 && c.g <= 0 && c.b <= 0)) return;
  if (light.mType == aiLightSource_AMBIENT) {
    model.ambient_light = c;
    return;
  }
  const aiVector3D position = world * light.mPosition;
  aiVector3D direction = aiMatrix3x3(world) * light.mDirection;
  direction.NormalizeSafe();
  Light to{.diffuse = c, .specular = c};
  switch (light.mType) {
    case aiLightSource_DIRECTIONAL: to.position = {-direction.x, -direction.y, -direction.z, 0}; break;
    case aiLightSource_SPOT: {
      to.spot_direction = {direction.x, direction.y, direction.z};
      // For Collada, assimp stores the falloff angle as the inner cone and invents the outer one.
      const double cutoff = is_collada ? light.mAngleInnerCone : light.mAngleOuterCone;
      to.spot_cutoff = cutoff >= std::numbers::pi
                           ? 180
                           : static_cast<float>(std::clamp(cutoff * kDegreesPerRadian, 0.0, 90.0));
      if (!is_collada)
        to.spot_exponent = spot_exponent_from_cone(light.mAngleInnerCone, light.mAngleOuterCone);
      [[fallthrough]];
    }
    case aiLightSource_POINT:
      to.position = {position.x, position.y, position.z, 1};
      set_attenuation(light, is_collada, to);
      break;
    default:
      model.warnings.push_back("light \"" + std::string(light.mName.C_Str()) +
                               "\" is neither directional, point, spot nor ambient, and left out");
      return;
  }
  const bool has_place = std::isfinite(to.position[0] + to.position[1] + to.position[2]);
  const bool has_direction = light.mType == aiLightSource_POINT || direction.SquareLength() > 0.5f;
  if (has_place && has_direction && !std::isnan(to.spot_cutoff)) model.lights.push_back(to);
}

}  // namespace tessera::program
