// One small quad per pixel of a small frame, lit by the engine and compared with the oracle.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <random>
#include <span>
#include <vector>

#include "tests/numerics/bounds.h"
#include "tests/numerics/lighting_oracle.h"

namespace tessera::test {

/// Random numbers that are identical on every machine and standard library.
struct LightingRng {
  std::mt19937 random;
  double unit() { return static_cast<double>(random()) * 0x1p-32; }
  double between(double low, double high) { return low + (high - low) * unit(); }
  bool one_in(unsigned n) { return random() % n == 0; }
  template <class Choice, std::size_t kCount>
  Choice of(const Choice (&choices)[kCount]) {
    return choices[random() % kCount];
  }
  std::array<float, 3> direction() {
    for (;;) {
      const Real3 v{between(-1, 1), between(-1, 1), between(-1, 1)};
      if (length(v) < 0.1L || length(v) > 1) continue;
      const Real3 n = normalized(v);
      return {static_cast<float>(n[0]), static_cast<float>(n[1]), static_cast<float>(n[2])};
    }
  }
};

/// Tolerance of cosines. The engine's cosines are within 15 * 2^-24 (light_terms_test.cpp) of those of its
/// inputs, and the input normals and directions were rounded once, each by less than 2^-24.
inline constexpr Real kCosineSlack = 20 * 0x1p-24L;

/// One quad. Its first and third corner coincide at the centre of its pixel; the last one is the provoking
/// vertex.
struct Patch {
  std::array<std::array<float, 3>, 4> normals{};
  std::array<float, 4> z{};
  bool front = true;
};

class LitPatches {
 public:
  static constexpr int kSide = 16;
  static constexpr int kCount = kSide * kSide;

  Material material;
  Material back_material;
  LightModel model{.ambient = {0, 0, 0, 1}};
  std::vector<Light> lights;
  Shading shading = Shading::gouraud;
  bool normalize = true;
  double extent = 1;  ///< half size of the visible square, a power of two
  Real slack = kCosineSlack;
  std::array<Patch, kCount> patches{};
  /// The camera. Patches are in eye space, lights in world space.
  Matrix view{};
  Matrix world_from_eye{};

  /// Places the camera in any orientation, up to 10^4 frame sizes from the world's origin. Each light keeps
  /// its eye-space position, apart from float rounding.
  void move_camera(LightingRng& rng) {
    const auto [ax, ay, az] = rng.direction();
    const auto [ex, ey, ez] = rng.direction();
    const double angle = rng.between(0, 360);
    const double far = extent * std::exp2(rng.between(-4, 13.28));
    view = rotate(angle, ax, ay, az) * translate(-far * ex, -far * ey, -far * ez);
    world_from_eye = translate(far * ex, far * ey, far * ez) * rotate(-angle, ax, ay, az);
    const auto moved = [&](const std::array<float, 3>& v, double w) {
      std::array<float, 3> to{};
      for (std::size_t i = 0; i < 3; ++i)
        to[i] = static_cast<float>(world_from_eye.m[4 * i] * v[0] + world_from_eye.m[4 * i + 1] * v[1] +
                                   world_from_eye.m[4 * i + 2] * v[2] + world_from_eye.m[4 * i + 3] * w);
      return to;
    };
    for (Light& l : lights) {
      const auto [x, y, z] = moved({l.position[0], l.position[1], l.position[2]}, l.position[3]);
      l.position = {x, y, z, l.position[3]};
      l.spot_direction = moved(l.spot_direction, 0);
    }
  }

  /// Corner k (0 to 3) of a patch, counter-clockwise as seen by the viewer.
  std::array<float, 3> corner(int patch, int k) const {
    const int column = patch % kSide + (k == 1 || k == 2), row = patch / kSide + (k < 2);
    const double scale = 2 * extent / kSide;
    return {static_cast<float>(column * scale - extent), static_cast<float>(extent - row * scale),
            patches[static_cast<std::size_t>(patch)].z[static_cast<std::size_t>(k)]};
  }

  /// Largest error of the stored colours over all pixels, in levels of 255. Storing accounts for half a
  /// level.
  Real error_in_levels() {
    draw();
    Real worst = 0;
    for (int p = 0; p < kCount; ++p) {
      const std::array<RealRange, 3> exact = color(p);
      for (std::size_t c = 0; c < 3; ++c) {
        const Real level = levels[static_cast<std::size_t>(p)][c];
        update_worst(worst, exact[c].low * 255 - level, level - exact[c].high * 255);
        unsaturated += level > 0 && level < 255;
      }
    }
    return worst;
  }
  std::array<std::array<int, 3>, kCount> levels{};
  std::size_t unsaturated = 0;  ///< components without clamping, over all frames

  void draw() {
    std::vector<float> positions, normals;
    for (int p = 0; p < kCount; ++p)
      for (int k = 0; k < 4; ++k) {
        // Back faces use the order 2 1 0 3: the last corner stays.
        const int turned = patches[static_cast<std::size_t>(p)].front ? k : (6 - k) % 4;
        const std::array<float, 3> at = corner(p, turned);
        const std::array<float, 3> n =
            patches[static_cast<std::size_t>(p)].normals[static_cast<std::size_t>(turned)];
        positions.insert(positions.end(), at.begin(), at.end());
        normals.insert(normals.end(), n.begin(), n.end());
      }
    Frame frame(buffer_);
    frame.clear({.color = Color{0, 0, 0, 1}});
    frame.set_camera({.view = view,
                      .projection = orthographic(-extent, extent, -extent, extent, -4 * extent, 4 * extent)});
    frame.set_lights(lights);
    frame.set_light_model(model);
    DrawState state;
    state.material = material;
    state.transform = world_from_eye;
    state.back_material = back_material;
    state.shading = shading;
    state.normalize = normalize;
    state.depth.enabled = false;
    frame.draw({.primitive = Primitive::quads, .positions = positions, .normals = normals}, state);
    std::vector<std::uint32_t> words(kCount);
    renderer_.finish(frame, {words.data(), kSide, kSide, 4 * kSide, PixelOrder::bgra8});
    for (std::size_t p = 0; p < kCount; ++p)
      for (std::size_t c = 0; c < 3; ++c) levels[p][c] = static_cast<int>(words[p] >> (16 - 8 * c) & 255);
  }

 private:
  RealPoint point(int p, int k) const {
    Real3 n = real3(patches[static_cast<std::size_t>(p)].normals[static_cast<std::size_t>(k)]);
    return {normalize ? normalized(n) : n, real3(corner(p, k))};
  }
  std::array<RealRange, 3> color(int p) const {
    const bool front = patches[static_cast<std::size_t>(p)].front || !model.two_sided;
    const Material& used = front ? material : back_material;
    if (shading == Shading::flat) return lit_color(used, lights, model, point(p, 3), slack, front, view);
    const RealPoint a = point(p, 0);
    const RealPoint b = point(p, 2);
    if (shading == Shading::phong)
      return lit_color(used, lights, model,
                       {normalized(a.normal + b.normal), (a.position + b.position) * 0.5L}, slack, front,
                       view);
    std::array<RealRange, 3> mean;
    const auto of_a = lit_color(used, lights, model, a, slack, front, view);
    const auto of_b = lit_color(used, lights, model, b, slack, front, view);
    for (std::size_t c = 0; c < 3; ++c) mean[c] = 0.5L * (of_a[c] + of_b[c]);
    return mean;
  }

  FrameBuffer buffer_{FrameBufferFormat{.width = kSide, .height = kSide}};
  Renderer renderer_{RendererOptions{.threads = 1}};
};

}  // namespace tessera::test
