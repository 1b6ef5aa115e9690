// Attacks on the conditions about alpha: `alpha_is_one`, `alpha_is_zero`, and alpha tests with one outcome.
#include <cmath>
#include <cstdio>
#include <limits>

#include "tests/engine/plan/attack_scene.h"

namespace tessera::test {
namespace {

constexpr float kBelowOne = 1 - 0x1p-24f;
constexpr float kAboveOne = 1 + 0x1p-23f;
constexpr float kSmallest = std::numeric_limits<float>::denorm_min();

std::string text_of(float value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.9g", static_cast<double>(value));
  return text;
}

enum class AlphaSource { material, lit_material, vertices };
constexpr const char* kAlphaSources[] = {"material", "lit material", "vertex colours"};

/// Two overlapping grids, so that the second blends with colours of the first.
AttackScene scene_with_alpha(const std::string& name, AlphaSource source, float alpha) {
  AttackScene scene{.name =
                        name + ", " + kAlphaSources[static_cast<int>(source)] + " alpha " + text_of(alpha)};
  MeshData mesh = bent_grid();
  set_colors(mesh, std::nullopt, alpha);
  if (source != AlphaSource::vertices) mesh.colors.clear();
  DrawState state;
  state.lighting = source == AlphaSource::lit_material;
  state.material.diffuse = {0.37f, 0.61f, 0.83f, alpha};
  scene.meshes = {mesh, mesh};
  scene.states = {state, state};
  scene.states[1].transform = translate(0.21, 0.13, 0.2);
  return scene;
}

void for_each_state(AttackScene& scene, const auto& change) {
  for (DrawState& state : scene.states) change(state);
}

// 1 and 0, and the floats next to them. Alpha is clamped to 0..1.
void add_blended_alphas(AttackScenes& scenes) {
  for (const float alpha :
       {1.0f, kBelowOne, kAboveOne, 254 / 255.0f, 2.5f, 0.0f, -0.0f, kSmallest, 1 / 255.0f, -1.0f})
    for (const AlphaSource source : {AlphaSource::material, AlphaSource::lit_material, AlphaSource::vertices})
      for (const int alpha_bits : {0, 8}) {
        AttackScene scene =
            scene_with_alpha(alpha_bits == 0 ? "blended" : "blended with alpha planes", source, alpha);
        scene.format.alpha_bits = alpha_bits;
        for_each_state(scene, [](DrawState& state) { state.blend = BlendState{}; });
        (alpha >= 1 ? scene.claimed : scene.not_claimed) = EffectReason::alpha_is_one;
        scenes.push_back(scene);
      }
}

// One vertex of the mesh differs.
void add_single_vertices(AttackScenes& scenes) {
  for (const float other :
       {kBelowOne, 254 / 255.0f, 0.0f, std::nanf(""), std::numeric_limits<float>::infinity()})
    for (const std::size_t vertex : {std::size_t{0}, std::size_t{41}, std::size_t{99}}) {
      AttackScene scene = scene_with_alpha(
          "vertex " + std::to_string(vertex) + " has alpha " + text_of(other), AlphaSource::vertices, 1);
      for_each_state(scene, [](DrawState& state) { state.blend = BlendState{}; });
      scene.meshes[0].colors[4 * vertex + 3] = other;
      scene.not_claimed = EffectReason::alpha_is_one;
      scenes.push_back(scene);
    }
}

// The reference is alpha, or a float next to it.
void add_alpha_tests(AttackScenes& scenes) {
  constexpr float kAlpha = 0.7f;
  for (const Compare func : {Compare::never, Compare::less, Compare::equal, Compare::lequal, Compare::greater,
                             Compare::notequal, Compare::gequal, Compare::always})
    for (const float reference : {kAlpha, std::nextafter(kAlpha, 0.0f), std::nextafter(kAlpha, 1.0f)}) {
      const AlphaSource source = scenes.size() % 2 == 0 ? AlphaSource::vertices : AlphaSource::material;
      AttackScene scene = scene_with_alpha(
          "alpha test " + std::to_string(static_cast<int>(func)) + " against " + text_of(reference), source,
          kAlpha);
      for_each_state(scene, [&](DrawState& state) {
        state.alpha_test = AlphaTest{func, reference};
        state.stencil = StencilState{{.fail = StencilOp::invert, .zpass = StencilOp::incr}};
      });
      scenes.push_back(scene);
    }
}

// All texels are opaque but one.
void add_textures(AttackScenes& scenes) {
  constexpr TextureEnv kEnvironments[] = {TextureEnv::modulate, TextureEnv::replace, TextureEnv::decal,
                                          TextureEnv::blend, TextureEnv::add};
  for (const TextureEnv env : kEnvironments)
    for (const int odd_alpha : {254, 255, 0})
      for (const bool is_linear : {false, true}) {
        AttackScene scene = scene_with_alpha("texture environment " + std::to_string(static_cast<int>(env)) +
                                                 ", one texel of alpha " + std::to_string(odd_alpha) +
                                                 (is_linear ? ", linear" : ", nearest"),
                                             AlphaSource::material, 1);
        std::vector<std::uint8_t> texels(8 * 8 * 4, 255);
        for (std::size_t i = 0; i < texels.size(); ++i)
          if (i % 4 != 3) texels[i] = static_cast<std::uint8_t>(37 * i);
        texels[4 * 29 + 3] = static_cast<std::uint8_t>(odd_alpha);
        scene.texture = std::make_shared<const Texture>(
            TextureImage{.pixels = texels.data(), .width = 8, .height = 8, .channels = 4},
            TextureSampler{.mag = is_linear ? TextureFilter::linear : TextureFilter::nearest,
                           .min = is_linear ? TextureFilter::linear_mipmap_linear : TextureFilter::nearest});
        for_each_state(scene, [&](DrawState& state) {
          state.texture_env = env;
          state.blend = BlendState{};
        });
        const bool is_opaque = odd_alpha == 255 || env == TextureEnv::decal;
        (is_opaque ? scene.claimed : scene.not_claimed) = EffectReason::alpha_is_one;
        scenes.push_back(scene);
      }
}

}  // namespace

AttackScenes alpha_attacks() {
  AttackScenes scenes;
  add_blended_alphas(scenes);
  add_single_vertices(scenes);
  add_alpha_tests(scenes);
  add_textures(scenes);
  return scenes;
}

// Factors that are nearly the identity, and equations that read the stored colour.
AttackScenes blend_attacks() {
  using enum BlendFactor;
  struct Blending {
    const char* name;
    BlendState state;
    bool replaces;  // for alpha 1
  };
  const Blending kBlendings[] = {
      {"constant alpha below 1", {.src = constant_alpha, .dst = zero, .color = {1, 1, 1, kBelowOne}}, false},
      {"constant alpha 1", {.src = constant_alpha, .dst = zero, .color = {1, 1, 1, 1}}, false},
      {"constant colour below 1",
       {.src = one, .dst = one_minus_constant_color, .color = {1, kBelowOne, 1, 1}},
       false},
      {"one, one minus source alpha", {.src = one, .dst = one_minus_src_alpha}, true},
      {"source alpha, zero", {.src = src_alpha, .dst = zero}, true},
      {"source alpha, one", {.src = src_alpha, .dst = one}, false},
      {"one, zero, but alpha one, one", {.src = one, .dst = zero, .src_alpha = one, .dst_alpha = one}, false},
      {"destination alpha", {.src = dst_alpha, .dst = one_minus_dst_alpha}, false},
      {"saturate", {.src = src_alpha_saturate, .dst = one_minus_src_alpha}, false},
      {"subtract", {.equation = BlendEquation::subtract}, true},
      {"reverse subtract", {.equation = BlendEquation::reverse_subtract}, false},
      {"min", {.equation = BlendEquation::min}, false},
      {"max", {.equation = BlendEquation::max}, false},
      {"zero, one", {.src = zero, .dst = one}, false},
      {"one minus source alpha, source alpha", {.src = one_minus_src_alpha, .dst = src_alpha}, false}};
  AttackScenes scenes;
  for (const Blending& blending : kBlendings)
    for (const float alpha : {1.0f, kBelowOne, 0.0f})
      for (const int alpha_bits : {0, 8}) {
        AttackScene scene = scene_with_alpha(
            std::string("blending ") + blending.name + (alpha_bits == 0 ? "" : ", alpha planes"),
            AlphaSource::vertices, alpha);
        scene.format.alpha_bits = alpha_bits;
        for_each_state(scene, [&](DrawState& state) { state.blend = blending.state; });
        if (alpha == 1) (blending.replaces ? scene.claimed : scene.not_claimed) = EffectReason::alpha_is_one;
        scenes.push_back(scene);
      }
  return scenes;
}

}  // namespace tessera::test
