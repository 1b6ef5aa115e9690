// Random surfaces under random lights, and the lighting equation of the specification in double.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "shading/lighting.h"

namespace tessera::test {
using namespace detail;

/// Inputs of plan_lighting() and the facing.
struct LightingCase {
  SurfaceMaterial material;
  TrackedColors tracked;
  std::vector<EyeLight> lights;
  LightingModel model;
  bool renormalize = false, negate_normal = false;

  LightingProgram program() const {
    LightingProgram p = plan_lighting(material, tracked, lights, model, nullptr);
    p.renormalize = renormalize;
    p.negate_normal = negate_normal;
    return p;
  }
};

struct LightingPoint {
  std::array<float, 3> normal{}, position{};
  Rgb vertex{};
};

class RandomLighting {
 public:
  explicit RandomLighting(std::uint32_t seed) : random_(seed) {}
  double unit() { return std::uniform_real_distribution<double>(0, 1)(random_); }
  float in(double low, double high) { return static_cast<float>(low + (high - low) * unit()); }
  bool one_in(int n) { return std::uniform_int_distribution<int>(1, n)(random_) == 1; }
  Rgb color() {
    if (one_in(4)) return {0, 0, 0};
    if (one_in(6)) return {in(-1, 1), in(-1, 1), in(-1, 1)};
    return {in(0, 0.6), in(0, 0.6), in(0, 0.6)};
  }
  std::array<float, 3> direction() {
    double x, y, z, squared;
    do {
      x = 2 * unit() - 1;
      y = 2 * unit() - 1;
      z = 2 * unit() - 1;
      squared = x * x + y * y + z * z;
    } while (squared < 0.01 || squared > 1);
    const double length = std::sqrt(squared);
    return {static_cast<float>(x / length), static_cast<float>(y / length), static_cast<float>(z / length)};
  }
  EyeLight light(LightKind kind) {
    EyeLight l;
    l.ambient = color();
    l.diffuse = color();
    l.specular = color();
    l.directional = kind == LightKind::directional;
    l.position = l.directional ? direction() : std::array<float, 3>{in(-4, 4), in(-4, 4), in(-6, 2)};
    l.spot_direction = direction();
    if (is_spot(kind) || (l.directional && one_in(4))) {
      constexpr float kCutoffs[] = {0, 5, 30, 45, 60, 89.9f, 90};
      constexpr float kExponents[] = {0, 0.5f, 1, 2, 20, 128, 1000};
      l.spot_cutoff = kCutoffs[std::uniform_int_distribution<std::size_t>(0, 6)(random_)];
      l.spot_exponent = kExponents[std::uniform_int_distribution<std::size_t>(0, 6)(random_)];
      // Most spot lights point towards the scene.
      if (!l.directional && !one_in(4)) {
        const float length = std::sqrt(l.position[0] * l.position[0] + l.position[1] * l.position[1] +
                                       (l.position[2] + 3) * (l.position[2] + 3)) +
                             1e-3f;
        l.spot_direction = {-l.position[0] / length, -l.position[1] / length, -(l.position[2] + 3) / length};
      }
    }
    if (kind == LightKind::attenuated_point || kind == LightKind::attenuated_spot) {
      l.attenuation = {in(0.5, 2), one_in(2) ? 0 : in(0, 1), one_in(2) ? 0 : in(0, 0.5)};
      if (l.attenuation[1] == 0 && l.attenuation[2] == 0) l.attenuation[0] = 2;
    }
    return l;
  }
  SurfaceMaterial material() {
    constexpr float kShininess[] = {0, 0.5f, 1, 5, 20, 76.8f, 128, 1000, 10000};
    return {color(), color(), color(), color(),
            kShininess[std::uniform_int_distribution<std::size_t>(0, 8)(random_)]};
  }
  LightingCase next() {
    LightingCase c;
    c.material = material();
    if (one_in(3)) c.tracked = {one_in(2), one_in(2), one_in(2), one_in(2)};
    const int count = std::uniform_int_distribution<int>(0, 5)(random_);
    for (int i = 0; i < count; ++i)
      c.lights.push_back(
          light(static_cast<LightKind>(std::uniform_int_distribution<int>(0, kLightKinds - 1)(random_))));
    c.model = {color(), one_in(2), one_in(2)};
    c.renormalize = c.model.unit_normals = one_in(2);
    c.negate_normal = one_in(2);
    return c;
  }
  LightingPoint point() {
    LightingPoint p{direction(), {in(-3, 3), in(-3, 3), in(-8, -0.5)}, {in(0, 1), in(0, 1), in(0, 1)}};
    const float length = one_in(3) ? in(0.1, 1.5) : 1;
    for (float& n : p.normal) n *= length;
    if (one_in(40)) p.normal = {0, 0, 0};
    return p;
  }

 private:
  std::mt19937 random_;
};

/// The terms of the lighting equation in double. They clear `smooth` if the equation is discontinuous within
/// rounding of the point.
namespace lighting_equation {

using Vec = std::array<double, 3>;
constexpr double kNear = 3e-6;

inline double dot(const Vec& a, const Vec& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Vec normalized(const Vec& v) {
  const double length = std::sqrt(dot(v, v));
  return length > 0 ? Vec{v[0] / length, v[1] / length, v[2] / length} : Vec{0, 0, 0};
}
inline Vec to_double(const std::array<float, 3>& v) { return {v[0], v[1], v[2]}; }
inline double power(double x, double y) { return y == 0 ? 1.0 : std::pow(std::max(x, 0.0), y); }

inline double attenuation(const EyeLight& light, double distance, bool& smooth) {
  if (light.directional) return 1;
  const double denominator =
      light.attenuation[0] + light.attenuation[1] * distance + light.attenuation[2] * distance * distance;
  smooth &= std::abs(denominator) > kNear || distance == 0;
  return denominator > 0 ? 1 / denominator : 1e6;
}

/// @param l  unit vector towards the light
inline double spot(const EyeLight& light, const Vec& l, double distance, bool& smooth) {
  if (light.spot_cutoff == 180) return 1;
  const double cosine = -dot(l, to_double(light.spot_direction));
  const double edge = std::cos(light.spot_cutoff * 3.14159265358979323846 / 180);
  smooth &= std::abs(cosine - edge) > kNear;
  smooth &= std::abs(cosine) > kNear || distance == 0;
  return cosine < edge || cosine <= 0 ? 0 : power(cosine, light.spot_exponent);
}

/// @param n, l, e  normal, unit vectors towards light and viewer
inline double highlight(const LightingCase& c, const Vec& n, const Vec& l, const Vec& e, bool& smooth) {
  const double n_dot_l = dot(n, l);
  if (!(n_dot_l > 0)) return 0;
  const Vec half{l[0] + e[0], l[1] + e[1], l[2] + e[2]};
  const Vec r{2 * n_dot_l * n[0] - l[0], 2 * n_dot_l * n[1] - l[1], 2 * n_dot_l * n[2] - l[2]};
  const double base = c.model.phong_highlight ? dot(r, e) : dot(normalized(half), n);
  const float shininess = c.material.shininess;
  // x^y is discontinuous at 0 for y = 0 and steep for y < 1. Normals longer than 1 make it diverge.
  smooth &= shininess >= 1 || shininess == 0 || std::abs(base) > 1e-3;
  smooth &= shininess <= 20 || base < 1.00001;
  return power(base, shininess);
}

}  // namespace lighting_equation

/// The lighting equation (section 5 of the specification) in double. Clears `smooth` if it is discontinuous
/// within rounding of this point.
inline std::array<double, 3> lighting_formula(const LightingCase& c, const LightingPoint& p, bool& smooth) {
  using namespace lighting_equation;
  Vec n = to_double(p.normal);
  if (c.renormalize) n = normalized(n);
  if (c.negate_normal)
    for (double& x : n) x = -x;
  const Vec towards_eye = to_double({-p.position[0], -p.position[1], -p.position[2]});
  const Vec e = c.model.local_viewer ? normalized(towards_eye) : Vec{0, 0, 1};
  const auto material = [&](bool tracked, const Rgb& own) { return to_double(tracked ? p.vertex : own); };
  const Vec ambient = material(c.tracked.ambient, c.material.ambient);
  const Vec diffuse = material(c.tracked.diffuse, c.material.diffuse);
  const Vec specular = material(c.tracked.specular, c.material.specular);

  Vec sum = material(c.tracked.emission, c.material.emission);
  for (std::size_t k = 0; k < 3; ++k) sum[k] += static_cast<double>(c.model.scene_ambient[k]) * ambient[k];
  for (const EyeLight& light : c.lights) {
    const Vec from_point = light.directional ? to_double(light.position)
                                             : Vec{double{light.position[0]} - p.position[0],
                                                   double{light.position[1]} - p.position[1],
                                                   double{light.position[2]} - p.position[2]};
    const double distance = std::sqrt(dot(from_point, from_point));
    const Vec l = normalized(from_point);
    const double factor = attenuation(light, distance, smooth) * spot(light, l, distance, smooth);
    const double n_dot_l = dot(n, l);
    const double spec = highlight(c, n, l, e, smooth);
    bool is_shiny = false;
    for (std::size_t k = 0; k < 3; ++k) is_shiny |= specular[k] * light.specular[k] != 0;
    if (is_shiny) {
      const Vec half{l[0] + e[0], l[1] + e[1], l[2] + e[2]};
      smooth &= std::abs(n_dot_l) > kNear || dot(n, n) == 0 || distance == 0;
      smooth &= c.model.phong_highlight || dot(half, half) > 1e-3;
    }
    for (std::size_t k = 0; k < 3; ++k)
      sum[k] +=
          factor * (light.ambient[k] * ambient[k] + std::max(n_dot_l, 0.0) * light.diffuse[k] * diffuse[k] +
                    spec * light.specular[k] * specular[k]);
  }
  for (double& s : sum) s = std::clamp(s, 0.0, 1.0);
  return sum;
}

/// Lights up to kBatchPoints points on one instruction set.
inline std::vector<Rgb> light(const LightingProgram& program, const std::vector<LightingPoint>& points,
                              InstructionSet isa) {
  ShadingBatch batch{};
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      batch.field[kNormalX + k][i] = points[i].normal[k];
      batch.field[kPositionX + k][i] = points[i].position[k];
      batch.field[kVertexR + k][i] = points[i].vertex[k];
    }
  }
  light_points(isa)(program, batch, static_cast<int>((points.size() + 15) / 16 * 16));
  std::vector<Rgb> colors;
  for (std::size_t i = 0; i < points.size(); ++i)
    colors.push_back({batch.field[kColorR][i], batch.field[kColorG][i], batch.field[kColorB][i]});
  return colors;
}

}  // namespace tessera::test
