// Overdraw, and many draws with different states.
#include <cmath>

#include "perf/bench/bench_meshes.h"
#include "perf/bench/drawn_workload.h"
#include "perf/bench/mesh_workloads.h"

namespace tessera::bench {
namespace {

constexpr int kDepthComplexity = 8;
constexpr int kDraws = 1000;

/// Full-window grids of 20,000 triangles at 8 depths.
Drawing overdraw_layers(int width, int height, bool front_first) {
  Drawing drawing;
  drawing.format = {.width = width, .height = height, .stencil_bits = 0};
  for (int k = 0; k < kDepthComplexity; ++k)
    drawing.meshes.push_back(window_grid(100, 100, 0.2f * static_cast<float>(front_first ? k - 4 : 3 - k)));
  drawing.fragments = static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height) *
                      (front_first ? 1 : kDepthComplexity);
  drawing.record = [](const Drawing& d, Frame& frame) {
    frame.clear({.color = Color{0, 0, 0, 1}, .depth = 1.0});
    DrawState state;
    state.lighting = false;
    for (const MeshData& mesh : d.meshes) frame.draw(mesh.view(), state);
  };
  return drawing;
}

/// State of draw k; the states of 1000 draws all differ.
DrawState state_of(int k, const Texture& texture, const Matrix& place) {
  DrawState state;
  state.lighting = k % 2 == 0;
  state.shading = k % 3 == 0 ? Shading::phong : Shading::gouraud;
  state.color_material = ColorMaterial::none;
  state.material.diffuse = {static_cast<float>(k % 10) / 9, static_cast<float>(k / 10 % 10) / 9,
                            static_cast<float>(k / 100 % 10) / 9, 1};
  state.depth.test = k % 5 == 0 ? Compare::always : Compare::lequal;
  if (k % 4 == 1) state.texture = &texture;
  if (k % 7 == 3) state.blend = BlendState{};
  state.transform = place;
  return state;
}

/// Patches of 32 triangles in a regular arrangement over the window, one draw each.
Drawing many_draws(int width, int height, int draws) {
  Drawing drawing;
  drawing.format = {.width = width, .height = height, .stencil_bits = 0};
  drawing.meshes.push_back(window_grid(4, 4));
  const std::vector<std::uint8_t> texels{255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 255, 255, 255, 255};
  drawing.textures.emplace_back(
      TextureImage{.pixels = texels.data(), .width = 2, .height = 2, .channels = 4});
  const int columns = static_cast<int>(std::lround(std::sqrt(1.6 * draws)));
  const int rows = (draws + columns - 1) / columns;
  drawing.record = [=](const Drawing& d, Frame& frame) {
    Light light;
    light.position = {0, 0, 1, 0};
    frame.set_lights({light});
    frame.clear({.color = Color{0, 0, 0, 1}, .depth = 1.0});
    for (int k = 0; k < draws; ++k) {
      const Matrix place =
          translate(2.0 * (k % columns + 0.5) / columns - 1, 2.0 * (k / columns + 0.5) / rows - 1, 0) *
          scale(1.0 / columns, 1.0 / rows, 1);
      frame.draw(d.meshes.front().view(), state_of(k, d.textures.front(), place));
    }
  };
  return drawing;
}

WorkloadEntry scene_entry(const std::string& name, const std::string& description,
                          std::function<Drawing(int width, int height)> make) {
  return drawn_outside_mean(
      name, description,
      [make = std::move(make)](int width, int height, std::uint32_t) { return make(width, height); });
}

}  // namespace

WorkloadEntry patches_in_separate_draws(int draws) {
  return scene_entry("draws-" + std::to_string(draws),
                     std::to_string(draws) + " draws of 32 triangles, all with different states",
                     [draws](int w, int h) { return many_draws(w, h, draws); });
}

std::vector<WorkloadEntry> scene_workloads() {
  return {scene_entry("depth-8-front", "8 full-screen layers of 20k triangles, front to back",
                      [](int w, int h) { return overdraw_layers(w, h, true); }),
          scene_entry("depth-8-back", "8 full-screen layers of 20k triangles, back to front",
                      [](int w, int h) { return overdraw_layers(w, h, false); }),
          patches_in_separate_draws(kDraws)};
}

}  // namespace tessera::bench
