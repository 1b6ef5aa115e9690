// Random lights, materials and patches for scenes of lit patches.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "tests/numerics/lit_patches.h"

namespace tessera::test {

inline constexpr float kExponents[] = {0, 0.5f, 1, 20, 128, 10000};
inline constexpr float kCutoffs[] = {0, 20, 89.999f, 90, 180};

inline Color random_color(LightingRng& rng, double largest, bool negative) {
  const auto c = [&] { return static_cast<float>(rng.between(negative ? -largest / 2 : 0, largest)); };
  const float r = c(), g = c();
  return {r, g, c(), 1};
}

/// A light of any kind around the scene. Its brightness is chosen so that `of` such lights together rarely
/// saturate.
inline Light random_light(LightingRng& rng, std::size_t of, double extent) {
  const double share = std::min(1.5, 8 / static_cast<double>(of));
  const bool negative = rng.one_in(4);
  Light l{.ambient = rng.one_in(2) ? Color{0, 0, 0, 1} : random_color(rng, share / 4, negative),
          .diffuse = random_color(rng, share, negative),
          .specular = random_color(rng, share, negative)};
  const auto [x, y, z] = rng.direction();
  if (rng.one_in(4)) {
    l.position = {x, y, z, 0};
  } else {
    const double distance = extent * rng.of({0.1, 1.0, 3.0, 100.0});
    const double w = rng.of({1.0, 2.0, -0.25});
    l.position = {static_cast<float>(x * distance * w), static_cast<float>(y * distance * w),
                  static_cast<float>(z * distance * w), static_cast<float>(w)};
    l.spot_cutoff = rng.of(kCutoffs);
    const auto [kc, kl, kq] =
        rng.of<std::array<double, 3>>({{1, 0, 0}, {2, 0, 0}, {0.5, 0.5, 0}, {0, 0, 1}, {1, 1, 1}, {0, 1, 0}});
    l.attenuation_constant = static_cast<float>(kc);
    l.attenuation_linear = static_cast<float>(kl / distance);
    l.attenuation_quadratic = static_cast<float>(kq / (distance * distance));
  }
  if (rng.one_in(2)) l.spot_cutoff = 180;
  l.spot_exponent = rng.of(kExponents);
  // Random offset, so that some lights point at the scene and some past it.
  const auto aim = rng.direction();
  l.spot_direction = {-x + 0.3f * aim[0], -y + 0.3f * aim[1], -z + 0.3f * aim[2]};
  return l;
}

inline Material random_material(LightingRng& rng) {
  Material m{.ambient = random_color(rng, 1, false),
             .diffuse = random_color(rng, 1, false),
             .specular = random_color(rng, 1, false),
             .emission = rng.one_in(2) ? Color{0, 0, 0, 1} : random_color(rng, 0.3, true)};
  m.shininess = rng.of(kExponents);
  return m;
}

inline void randomize_patches(LightingRng& rng, LitPatches& scene) {
  for (Patch& patch : scene.patches) {
    const std::array<float, 3> normal = rng.direction();
    for (std::size_t k = 0; k < 4; ++k) {
      const std::array<float, 3> bend = rng.direction();
      const double size = scene.normalize ? std::exp2(rng.between(-20, 20)) : rng.between(0.1, 1);
      for (std::size_t c = 0; c < 3; ++c)
        patch.normals[k][c] = static_cast<float>((normal[c] + 0.2 * bend[c]) * size / 1.2);
      patch.z[k] = static_cast<float>(scene.extent * rng.between(-2, 2));
    }
    patch.front = !rng.one_in(2);
  }
}

}  // namespace tessera::test
