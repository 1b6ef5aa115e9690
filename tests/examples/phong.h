// Phong lighting by one point light, as a user stage: lit at the pixels.
#pragma once

#include <tessera/tessera.hpp>

#include <algorithm>
#include <cmath>

// The data of the stage besides the fragments: the light in eye space, and the material.
struct Phong {
  float light[3], diffuse[3], specular;
  int shininess;

  static void run(const tessera::FragmentBlock& block, void* data) {
    const Phong& phong = *static_cast<const Phong*>(data);
    for (std::size_t i = 0; i < block.count; ++i) {
      float n[3], l[3], e[3];  // normal, direction to the light, direction to the eye
      for (std::size_t c = 0; c < 3; ++c) {
        n[c] = block.normal[c][i];
        l[c] = phong.light[c] - block.eye[c][i];
        e[c] = -block.eye[c][i];
      }
      normalize(n), normalize(l), normalize(e);
      const float facing = dot(n, l);
      const float r[3] = {2 * facing * n[0] - l[0], 2 * facing * n[1] - l[1], 2 * facing * n[2] - l[2]};
      float highlight = facing > 0 ? phong.specular : 0;
      for (int k = 0; k < phong.shininess; ++k) highlight *= std::max(dot(r, e), 0.0f);
      for (std::size_t c = 0; c < 3; ++c)
        block.color[c][i] = std::max(facing, 0.0f) * phong.diffuse[c] + highlight;
    }
  }
  static float dot(const float* a, const float* b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
  static void normalize(float* v) {
    const float length = std::sqrt(dot(v, v));
    for (int c = 0; c < 3 && length > 0; ++c) v[c] /= length;
  }
};
