// Attacks on the conditions of `light_behind` and `light_outside_cone`.
#include <cmath>
#include <cstdio>
#include <numbers>

#include "tests/engine/plan/attack_scene.h"

namespace tessera::test {
namespace {

std::string shown(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.9g", value);
  return text;
}

/// The normals of the grid are in the plane y = 0, at most 45 degrees from z.
MeshData grid_bent_in_x() {
  MeshData mesh = bent_grid(1);
  for (std::size_t i = 1; i < mesh.normals.size(); i += 3) mesh.normals[i] = 0;
  return mesh;
}

}  // namespace

// n.L lies a few ulp to either side of 0.
AttackScenes light_behind_attacks() {
  AttackScenes scenes;
  for (const float z :
       {0x1p-140f, 0x1p-24f, 0x1p-16f, 0x1p-13f, 0.0f, -0x1p-140f, -0x1p-24f, -0x1p-16f, -0x1p-13f, -0.01f})
    for (const Shading shading : kShadings) {
      AttackScene scene = lit_scene("grazing directional light, z " + shown(z), shading, grid_bent_in_x(),
                                    glaring_light(0, 1, z, 0));
      if (z >= 0) scene.not_claimed = EffectReason::light_behind;
      if (z == -0.01f) scene.claimed = EffectReason::light_behind;
      scenes.push_back(scene);
    }
  // The light moves through the plane of the grid, outside of its border.
  for (const float z : {0x1p-100f, 0x1p-22f, 0x1p-12f, 0.0f, -0x1p-100f, -0x1p-22f, -0x1p-12f, -0.1f})
    for (const Shading shading : kShadings) {
      AttackScene scene =
          lit_scene("grazing point light, z " + shown(z), shading, bent_grid(0), glaring_light(1, 2, z, 1));
      scene.meshes[0].normals[2] = 2;  // otherwise all normals are equal
      if (z >= 0) scene.not_claimed = EffectReason::light_behind;
      if (z == -0.1f) scene.claimed = EffectReason::light_behind;
      scenes.push_back(scene);
    }
  return scenes;
}

// The nearest points of the grid are at the angle of the cone, or beyond it by a few ulp.
AttackScenes light_cone_attacks() {
  AttackScenes scenes;
  for (const double cutoff : {0.0, 0.25, 1.0, 10.0, 45.0, 89.999, 90.0})
    for (const double beyond : {-1e-5, 0.0, 1e-6, 1e-4, 2.0})
      for (const Shading shading : {Shading::gouraud, Shading::phong}) {
        MeshData mesh = bent_grid();  // moved, so that its edge is at x = 0
        for (std::size_t i = 0; i < mesh.positions.size(); i += 3) mesh.positions[i] += 0.8f;
        Light light = glaring_light(0, 0, 1, 1);
        const double angle = (cutoff + beyond) * std::numbers::pi / 180;
        light.spot_direction = {static_cast<float>(-std::sin(angle)), 0,
                                static_cast<float>(-std::cos(angle))};
        light.spot_cutoff = static_cast<float>(cutoff);
        AttackScene scene =
            lit_scene("cone of " + shown(cutoff) + " degrees, edge " + shown(beyond) + " degrees beyond",
                      shading, std::move(mesh), light);
        if (beyond < 0) scene.not_claimed = EffectReason::light_outside_cone;
        if (beyond == 2.0) scene.claimed = EffectReason::light_outside_cone;
        scenes.push_back(scene);
      }
  return scenes;
}

// Negative light, attenuation of zero and less, ambient parts of lights that are behind or elsewhere.
AttackScenes light_strength_attacks() {
  AttackScenes scenes;
  struct Strength {
    const char* name;
    float constant, linear, diffuse, ambient;
  };
  constexpr Strength kStrengths[] = {
      {"negative light", 1, 0, -0.5f, 0},           {"attenuation 0", 0, 0, 1e-6f, 0},
      {"negative attenuation", -2, 0.1f, 1e-6f, 0}, {"attenuation through zero", -4, 1, 1e-6f, 0},
      {"ambient part", 1, 0, 0.5f, 0.25f},          {"negative ambient part", 1, 0, 0.5f, -0.1f}};
  for (const Strength& s : kStrengths)
    for (const bool is_behind : {false, true})
      for (const bool has_cone : {false, true})
        for (const Shading shading : {Shading::gouraud, Shading::phong}) {
          Light light;
          light.position = {0.5f, 0.5f, is_behind ? -2.0f : 2.0f, 1};
          light.diffuse = {s.diffuse, s.diffuse, 0, 1};
          light.ambient = {s.ambient, 0, s.ambient, 1};
          light.attenuation_constant = s.constant;
          light.attenuation_linear = s.linear;
          light.spot_direction = {0, 0, is_behind ? 1.0f : -1.0f};
          if (has_cone) light.spot_cutoff = 30;
          AttackScene scene =
              lit_scene(std::string(s.name) + (is_behind ? ", behind" : "") + (has_cone ? ", cone" : ""),
                        shading, bent_grid(), light);
          const bool is_left_out = is_behind && s.ambient == 0;
          (is_left_out ? scene.claimed : scene.not_claimed) = EffectReason::light_behind;
          scenes.push_back(scene);
        }
  return scenes;
}

}  // namespace tessera::test
