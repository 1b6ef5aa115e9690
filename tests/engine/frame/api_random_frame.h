// A frame with many kinds of triangles: all sizes in random order, many cut by the near and far planes and
// the window edges, with much overdraw, in every kind of shading.
#pragma once

#include <vector>

#include "tests/engine/frame/api_support.h"

namespace tessera::test {

struct RandomFrame {
  FrameBufferFormat format;
  MeshData triangles;
  MeshData strip;
  std::vector<Light> lights;
  Camera camera;

  explicit RandomFrame(FrameBufferFormat f = {.width = 330, .height = 210}, int count = 1500)
      : format(std::move(f)) {
    Random random(20);
    for (int i = 0; i < count; ++i) {
      float size = 0.08f;
      if (i % 4 == 0) size = 0.8f;
      if (i % 16 == 0) size = 6.0f;
      const float center[3] = {random.between(-4, 4), random.between(-3, 3), random.between(-9, 1)};
      for (int k = 0; k < 3; ++k) {
        for (const float c : center) triangles.positions.push_back(c + random.between(-size, size));
        for (int c = 0; c < 3; ++c) triangles.normals.push_back(random.between(-1, 1));
        for (int c = 0; c < 4; ++c) triangles.colors.push_back(random.between(0, 1));
      }
    }
    // A sheet of shared vertices, without normals.
    const std::uint32_t side = 12;
    for (std::uint32_t y = 0; y < side; ++y)
      for (std::uint32_t x = 0; x < side; ++x)
        for (const float c :
             {static_cast<float>(x) - 5.5f, static_cast<float>(y) - 5.5f, random.between(-7, -3)})
          strip.positions.push_back(c * 0.8f);
    for (std::uint32_t y = 0; y + 1 < side; ++y)
      for (std::uint32_t x = 0; x + 1 < side; ++x) {
        const std::uint32_t a = y * side + x;
        strip.indices.insert(strip.indices.end(), {a, a + 1, a + side + 1, a, a + side + 1, a + side});
      }
    Light point;
    point.position = {1, 2, 0, 1};
    point.diffuse = {0.9f, 0.6f, 0.3f, 1};
    point.attenuation_linear = 0.1f;
    Light spot;
    spot.position = {-2, 1, 1, 1};
    spot.spot_direction = {0.4f, -0.2f, -1};
    spot.spot_cutoff = 40;
    spot.spot_exponent = 7.5f;
    lights = {Light{}, point, spot};
    camera.projection = perspective(60, static_cast<double>(format.width) / format.height, 0.5, 7);
  }

  /// Records the frame, which borrows the meshes.
  void record(Frame& frame) const {
    Clear clear;
    clear.color = Color{0.1f, 0.2f, 0.3f, 1};
    if (format.depth != DepthFormat::none) clear.depth = 1.0;
    frame.clear(clear);
    frame.set_camera(camera);
    frame.set_lights(lights);
    DrawState state;
    state.material.specular = {0.5f, 0.5f, 0.4f, 1};
    state.material.shininess = 12;
    for (const Shading shading : {Shading::gouraud, Shading::flat, Shading::phong}) {
      state.shading = shading;
      frame.set_light_model(
          {.local_viewer = shading != Shading::flat, .two_sided = shading == Shading::phong});
      state.color_material =
          shading == Shading::flat ? ColorMaterial::ambient_and_diffuse : ColorMaterial::none;
      state.transform = translate(0.1 * static_cast<int>(shading), 0, 0) *
                        rotate(20.0 * static_cast<int>(shading), 0, 0, 1);
      frame.draw(triangles.view(), state);
      frame.draw(strip.view(), state);
    }
    // Layers without a depth test: the recording order decides.
    state.depth.enabled = false;
    state.lighting = false;
    state.scissor = Rect{40, 30, 120, 90};
    state.transform = translate(0, 0, -1);
    frame.draw(triangles.view(), state);
    if (format.color_mode == ColorMode::rgb) state.plane_mask = 0x5a5a5au;
    state.scissor = Rect{140, 60, 120, 90};
    frame.draw(triangles.view(), state);
  }
};

}  // namespace tessera::test
