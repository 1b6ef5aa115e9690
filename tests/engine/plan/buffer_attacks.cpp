// Attacks that vary the buffers around effects that are left out: depths one level apart, masks, dither,
// scissors, samples, colour-index buffers.
#include "tests/engine/plan/attack_scene.h"

namespace tessera::test {
namespace {

/// Two grids of the same shape, whose second would show through errors of the first.
AttackScene two_grids(const std::string& name) {
  AttackScene scene{.name = name};
  MeshData mesh = bent_grid();
  set_colors(mesh, std::nullopt, 1);
  DrawState state;
  state.lighting = false;
  state.blend = BlendState{};
  scene.meshes = {mesh, mesh};
  set_colors(scene.meshes[1], Color{0.9f, 0.4f, 0.2f, 1}, 1);
  scene.states = {state, state};
  scene.states[1].transform = translate(0.1, 0.07, 0);
  scene.claimed = EffectReason::alpha_is_one;
  return scene;
}

void draw_both(AttackScene& scene, const auto& change) {
  for (DrawState& state : scene.states) change(state);
}

}  // namespace

// The second grid lies in the plane of the first, moved by a level of the depth buffer or not at all.
AttackScenes depth_attacks() {
  struct Format {
    const char* name;
    DepthFormat format;
  };
  constexpr Format kFormats[] = {{"unorm16", DepthFormat::unorm16},
                                 {"unorm24", DepthFormat::unorm24},
                                 {"unorm32", DepthFormat::unorm32},
                                 {"float32", DepthFormat::float32}};
  AttackScenes scenes;
  for (const Format& format : kFormats)
    for (const float levels : {-1.0f, 0.0f, 1.0f})
      for (const Compare test : {Compare::less, Compare::lequal, Compare::equal, Compare::gequal}) {
        AttackScene scene =
            two_grids(std::string("depths ") + std::to_string(static_cast<int>(levels)) + " levels apart, " +
                      format.name + ", test " + std::to_string(static_cast<int>(test)));
        scene.format.depth = format.format;
        draw_both(scene, [](DrawState& state) { state.transform = state.transform * rotate(30, 0, 1, 0); });
        scene.states[1].depth.test = test;
        scene.states[1].polygon_offset.units = levels;
        if (scenes.size() % 2 == 0) scene.states[1].depth.write = false;
        scenes.push_back(scene);
      }
  return scenes;
}

AttackScenes buffer_attacks() {
  AttackScenes scenes;
  for (const Dither dither : {Dither::none, Dither::bayer2, Dither::bayer4, Dither::bayer8})
    for (const int bits : {24, 8, 3})
      for (const bool is_masked : {false, true}) {
        AttackScene scene = two_grids("dither " + std::to_string(static_cast<int>(dither)) + ", " +
                                      std::to_string(bits) + " bits" + (is_masked ? ", masked" : ""));
        scene.format.dither = dither;
        scene.format.color_bits = bits;
        scene.format.alpha_bits = is_masked ? 8 : 0;
        if (is_masked)
          draw_both(scene, [](DrawState& state) { state.color_mask = {true, false, true, false}; });
        scenes.push_back(scene);
      }
  // Rectangles that end at borders of tiles, a pixel from them, or inside of tiles; and empty ones.
  for (const Rect& scissor :
       {Rect{0, 0, 32, 32}, Rect{31, 31, 1, 1}, Rect{31, 0, 2, 70}, Rect{64, 0, 8, 70}, Rect{-5, -5, 20, 90},
        Rect{20, 20, 0, 10}, Rect{72, 0, 10, 10}, Rect{1, 1, 70, 68}})
    for (const int samples : {1, 4}) {
      AttackScene scene =
          two_grids("scissor " + std::to_string(scissor.x) + " " + std::to_string(scissor.y) + " " +
                    std::to_string(scissor.width) + " " + std::to_string(scissor.height) + ", " +
                    std::to_string(samples) + " samples");
      scene.format.samples = samples;
      draw_both(scene, [&](DrawState& state) { state.scissor = scissor; });
      scenes.push_back(scene);
    }
  for (const int samples : {1, 4, 8})
    for (const Shading shading : kShadings)
      for (const bool tests_alpha : {false, true}) {
        AttackScene scene = two_grids(std::to_string(samples) + " samples, light behind, " +
                                      name_of(shading) + (tests_alpha ? ", alpha test" : ""));
        scene.format.samples = samples;
        scene.lights = {Light{}, glaring_light(0.1f, 0.2f, -1, 0)};
        draw_both(scene, [&](DrawState& state) {
          state.lighting = true;
          state.shading = shading;
          if (tests_alpha) state.alpha_test = AlphaTest{Compare::gequal, 1};
        });
        scene.claimed = EffectReason::light_behind;
        scenes.push_back(scene);
      }
  // The centres of most pixels are outside of slivers.
  for (const int samples : {4, 8})
    for (const float light_z : {-0.3f, -0.05f, 0.05f}) {
      AttackScene scene =
          two_grids(std::to_string(samples) + " samples, slivers, light at z " + std::to_string(light_z));
      scene.format.samples = samples;
      draw_both(scene, [&](DrawState& state) {
        state.lighting = true;
        state.shading = Shading::phong;
        state.transform = rotate(25, 0, 0, 1) * scale(1, 0.01, 1) * rotate(70, 1, 0, 0);
      });
      scene.lights = {Light{}, glaring_light(0.3f, 0.2f, light_z, 1)};
      scene.claimed.reset();
      scenes.push_back(scene);
    }
  for (const int bits : {1, 4, 8})
    for (const float z : {1.0f, -1.0f})
      for (const Shading shading : kShadings) {
        AttackScene scene = two_grids("index of " + std::to_string(bits) + " bits, light at z " +
                                      std::to_string(static_cast<int>(z)) + ", " + name_of(shading));
        scene.format.color_mode = ColorMode::index;
        scene.format.color_bits = bits;
        scene.lights = {glaring_light(0.1f, 0.2f, z, 0)};
        draw_both(scene, [&](DrawState& state) {
          state.blend.reset();
          state.lighting = true;
          state.shading = shading;
          state.material.index_ramp = {{0, 5, 12}};
        });
        scene.claimed.reset();
        (z < 0 ? scene.claimed : scene.not_claimed) = EffectReason::light_behind;
        scenes.push_back(scene);
      }
  return scenes;
}

}  // namespace tessera::test
