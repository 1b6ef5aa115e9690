// Effects that are left out because of the data of a draw: the bits stay those of the frame with every effect
// in full, and each reason disappears with its cause.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include "tests/engine/frame/api_support.h"

namespace tessera::elision_test {
namespace {

using namespace test;

/// Two draws of a mesh with the same state.
struct Scenery {
  FrameBufferFormat format{.width = 48, .height = 40};
  MeshData mesh;
  DrawState state;
  std::vector<Light> lights{Light{}};
  LightModel model;
  std::optional<Texture> texture;

  void record(Frame& frame) const {
    frame.clear({.color = Color{0.2f, 0.4f, 0.6f, 0.5f}, .depth = 1.0, .stencil = 1});
    frame.set_camera(
        {.view = look_at({0, 0, 4}, {0, 0, 0}, {0, 1, 0}), .projection = perspective(45, 1.2, 0.5, 20)});
    frame.set_lights(lights);
    frame.set_light_model(model);
    DrawState drawn = state;
    drawn.texture = texture ? &*texture : nullptr;
    frame.draw(mesh.view(), drawn);
    drawn.transform = translate(0.3, -0.2, -0.1) * drawn.transform;
    frame.draw(mesh.view(), drawn);
  }
  Fingerprint picture(bool elide) const {
    FrameBuffer buffer(format);
    Frame frame(buffer);
    record(frame);
    Renderer({.threads = 1, .elide = elide}).finish(frame);
    return fingerprint(buffer);
  }
  std::vector<EffectNote> effects() const {
    FrameBuffer buffer(format);
    Frame frame(buffer);
    record(frame);
    return frame.effects(0);
  }
  bool has(EffectReason reason) const {
    const std::vector<EffectNote> notes = effects();
    return std::any_of(notes.begin(), notes.end(),
                       [&](const EffectNote& note) { return note.reason == reason; });
  }
};

/// A patch of a sphere of radius `radius` around the origin, seen from +z.
/// @param spread  angle of its edge from +z, radians
MeshData patch(double spread, double radius = 1.2, int side = 8) {
  MeshData mesh;
  for (int y = 0; y <= side; ++y)
    for (int x = 0; x <= side; ++x) {
      const double u = spread * (2.0 * x / side - 1), v = spread * (2.0 * y / side - 1);
      const double n[3] = {std::sin(u), std::cos(u) * std::sin(v), std::cos(u) * std::cos(v)};
      for (const double c : n) {
        mesh.positions.push_back(static_cast<float>(c * radius));
        mesh.normals.push_back(static_cast<float>(c));
      }
      mesh.texcoords.insert(mesh.texcoords.end(), {static_cast<float>(x), static_cast<float>(y)});
    }
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const auto a = static_cast<std::uint32_t>(y * (side + 1) + x),
                 b = a + static_cast<std::uint32_t>(side) + 1;
      mesh.indices.insert(mesh.indices.end(), {a, a + 1, b + 1, a, b + 1, b});
    }
  return mesh;
}

void set_colors(MeshData& mesh, Random& random, float alpha) {
  mesh.colors.clear();
  for (std::size_t i = 0; i < mesh.vertex_count(); ++i) {
    for (int c = 0; c < 3; ++c) mesh.colors.push_back(random.between(0, 1));
    mesh.colors.push_back(alpha);
  }
}

Texture random_texture(Random& random, int channels, std::uint8_t alpha) {
  std::vector<std::uint8_t> texels(static_cast<std::size_t>(8 * 8 * channels));
  for (std::size_t i = 0; i < texels.size(); ++i) {
    const bool is_alpha = channels == 4 && i % 4 == 3;
    texels[i] = is_alpha ? alpha : static_cast<std::uint8_t>(random.next());
  }
  return Texture({.pixels = texels.data(), .width = 8, .height = 8, .channels = channels},
                 {.mag = TextureFilter::linear, .min = TextureFilter::linear_mipmap_linear});
}

template <class T>
T one_of(Random& random, std::initializer_list<T> values) {
  return values.begin()[random.next() % values.size()];
}

Light random_light(Random& random) {
  Light light;
  const float w = one_of(random, {0.0f, 1.0f, 1.0f});
  light.position = {random.between(-3, 3), random.between(-3, 3), random.between(-4, 3), w};
  light.diffuse = {random.between(-0.2f, 1), random.between(0, 1), random.between(0, 1), 1};
  if (random.next() % 4 == 0) light.ambient = {0.1f, 0.2f, 0, 1};
  if (random.next() % 2 == 0) {
    light.spot_cutoff = one_of(random, {0.0f, 0.5f, 5.0f, 20.0f, 45.0f, 90.0f});
    light.spot_direction = {random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)};
    light.spot_exponent = one_of(random, {0.0f, 3.0f});
  }
  if (random.next() % 3 == 0) {
    light.attenuation_constant = one_of(random, {0.0f, 1.0f, -0.5f});
    light.attenuation_linear = random.between(-0.2f, 0.5f);
  }
  return light;
}

void randomize_operations(Scenery& s, Random& random) {
  const float alpha = one_of(random, {0.0f, 254 / 255.0f, 1.0f, 1.0f, 1.5f});
  s.state.material.diffuse.a = one_of(random, {0.0f, 0.5f, 1.0f, 1.0f});
  if (random.next() % 2 == 0) set_colors(s.mesh, random, alpha);
  s.state.color_material =
      one_of(random, {ColorMaterial::none, ColorMaterial::diffuse, ColorMaterial::ambient});
  if (random.next() % 2 == 0)
    s.state.blend = one_of(random, {BlendState{}, BlendState{.dst = BlendFactor::one},
                                    BlendState{.equation = BlendEquation::reverse_subtract}});
  if (random.next() % 3 == 0)
    s.state.alpha_test = AlphaTest{one_of(random, {Compare::greater, Compare::lequal, Compare::equal}),
                                   one_of(random, {0.0f, 0.5f, 1.0f})};
  if (random.next() % 3 == 0)
    s.state.stencil = StencilState{.front = {.func = Compare::equal, .ref = 1, .zpass = StencilOp::incr}};
  if (random.next() % 4 == 0)
    s.texture = random_texture(random, one_of(random, {3, 4}), one_of<std::uint8_t>(random, {254, 255, 255}));
  s.state.texture_env = one_of(random, {TextureEnv::modulate, TextureEnv::replace, TextureEnv::decal});
}

Scenery random_scenery(std::uint64_t seed) {
  Random random(seed);
  Scenery s;
  s.format.samples = one_of(random, {1, 1, 1, 4});
  s.format.alpha_bits = one_of(random, {0, 0, 8});
  s.format.dither = one_of(random, {Dither::none, Dither::none, Dither::bayer4});
  s.mesh = patch(random.between(0.02f, 1.5f));
  const bool has_equal_normals = random.next() % 6 == 0;
  if (has_equal_normals)
    for (std::size_t i = 0; i < s.mesh.normals.size(); ++i) s.mesh.normals[i] = i % 3 == 2 ? 1.0f : 0.0f;
  if (random.next() % 8 == 0) s.mesh.normals.clear();
  if (random.next() % 8 == 0) s.mesh.primitive = one_of(random, {Primitive::points, Primitive::lines});
  s.state.point_size = 3;
  s.lights.clear();
  for (std::uint32_t i = 1 + random.next() % 6; i > 0; --i) s.lights.push_back(random_light(random));
  if (has_equal_normals)
    for (Light& light : s.lights) light.position[3] = 0;
  s.model = {.local_viewer = random.next() % 2 == 0, .two_sided = random.next() % 3 == 0};
  s.state.shading = one_of(random, {Shading::flat, Shading::gouraud, Shading::phong});
  s.state.lighting = random.next() % 5 != 0;
  s.state.normalize = random.next() % 3 != 0;
  s.state.material.specular = {0.5f, 0.5f, 0.5f, 1};
  s.state.material.shininess = one_of(random, {0.0f, 8.0f, 3000.0f});
  s.state.transform = rotate(random.between(-80, 80), 0.3, 1, 0.2) *
                      scale(random.between(0.5f, 1.5f), random.between(0.5f, 1.5f), 1);
  if (random.next() % 6 == 0) s.state.front_mode = one_of(random, {PolygonMode::line, PolygonMode::point});
  randomize_operations(s, random);
  return s;
}

TEST(Elision, KeepsEveryBitOfRandomDraws) {
  std::map<EffectReason, int> draws_with;
  for (std::uint64_t seed = 1; seed <= 1200; ++seed) {
    const Scenery s = random_scenery(seed);
    ASSERT_EQ(s.picture(true), s.picture(false)) << "seed " << seed;
    for (const EffectNote& note : s.effects()) ++draws_with[note.reason];
  }
  for (const EffectReason reason :
       {EffectReason::light_behind, EffectReason::light_outside_cone, EffectReason::alpha_is_one,
        EffectReason::alpha_is_zero, EffectReason::every_fragment_passes, EffectReason::every_fragment_fails,
        EffectReason::equal_normals}) {
    std::printf("%s: %d draws\n", std::string(code(reason)).c_str(), draws_with[reason]);
    EXPECT_GE(draws_with[reason], 10) << code(reason);
  }
}

TEST(Elision, LeavesOutLightsBehindEveryNormal) {
  Scenery s{.mesh = patch(0.6)};
  s.lights.resize(2);
  s.lights[1].position = {0, 0.5f, -1, 0};
  for (const Shading shading : {Shading::flat, Shading::gouraud, Shading::phong}) {
    s.state.shading = shading;
    s.lights[1].position = {0, 0.5f, -1, 0};
    EXPECT_TRUE(s.has(EffectReason::light_behind)) << static_cast<int>(shading);
    s.lights[1].position = {0, 1, -0.3f, 0};
    EXPECT_FALSE(s.has(EffectReason::light_behind)) << "it grazes the upper edge";
    s.lights[1].position = {0, 0, -5, 1};
    EXPECT_TRUE(s.has(EffectReason::light_behind)) << "a point light";
  }
  s.lights[1].ambient = {0.1f, 0, 0, 1};
  EXPECT_FALSE(s.has(EffectReason::light_behind)) << "its ambient part reaches all points";
}

TEST(Elision, LeavesOutLightsWhoseConeIsElsewhere) {
  Scenery s{.mesh = patch(0.3)};
  s.lights.resize(2);
  s.lights[1].position = {0, 0, 4, 1};
  s.lights[1].spot_cutoff = 10;
  s.lights[1].spot_direction = {1, 0, -1};
  EXPECT_TRUE(s.has(EffectReason::light_outside_cone));
  s.lights[1].spot_direction = {0, 0, -1};
  EXPECT_FALSE(s.has(EffectReason::light_outside_cone));
  s.lights[1].spot_direction = {1, 0, -1};
  s.lights[1].spot_cutoff = 180;
  EXPECT_FALSE(s.has(EffectReason::light_outside_cone));
}

TEST(Elision, LeavesOutBlendingOfAlpha1) {
  Scenery s{.mesh = patch(0.5)};
  s.state.blend = BlendState{};
  EXPECT_TRUE(s.has(EffectReason::alpha_is_one));
  s.state.material.diffuse.a = 254 / 255.0f;
  EXPECT_FALSE(s.has(EffectReason::alpha_is_one));
  Random random(1);
  s.state.lighting = false;
  set_colors(s.mesh, random, 1);
  EXPECT_TRUE(s.has(EffectReason::alpha_is_one));
  s.mesh.colors[7] = 254 / 255.0f;
  EXPECT_FALSE(s.has(EffectReason::alpha_is_one));
  s.mesh.colors[7] = 1;
  s.state.blend->equation = BlendEquation::max;
  EXPECT_FALSE(s.has(EffectReason::alpha_is_one)) << "the equation reads the stored colour";
}

// A million pixels: some are close to the border between two levels. Colours interpolated in levels round
// differently there.
TEST(Elision, RoundsColorsBetweenTwoLevelsAsBlendingDoes) {
  Scenery s{.format = {.width = 1024, .height = 1024}, .mesh = whole_window()};
  s.mesh.colors = {0.13f, 0.57f, 0.83f, 1, 0.91f, 0.22f, 0.31f, 1, 0.7f, 0.9f, 0.4f, 1, 0.2f, 0.3f, 0.6f, 1};
  s.state.lighting = false;
  for (const bool tests_alpha : {false, true}) {
    if (tests_alpha) s.state.alpha_test = AlphaTest{};
    else s.state.blend = BlendState{};
    FrameBuffer pictures[2] = {FrameBuffer(s.format), FrameBuffer(s.format)};
    for (const bool elide : {false, true}) {
      Frame frame(pictures[elide ? 1 : 0]);
      frame.draw(s.mesh.view(), s.state);
      EXPECT_EQ(frame.explain(0).find("skipped, ") != std::string::npos, true);
      Renderer({.threads = 1, .elide = elide}).finish(frame);
    }
    EXPECT_EQ(fingerprint(pictures[1]), fingerprint(pictures[0]));
    s.state.blend.reset();
  }
}

TEST(Elision, LeavesOutBlendingWithOpaqueTexels) {
  Random random(2);
  Scenery s{.mesh = patch(0.5)};
  s.state.blend = BlendState{};
  s.texture = random_texture(random, 4, 255);
  EXPECT_TRUE(s.has(EffectReason::alpha_is_one));
  s.texture = random_texture(random, 4, 254);
  EXPECT_FALSE(s.has(EffectReason::alpha_is_one));
}

TEST(Elision, LeavesOutColorsOfAlpha0) {
  Scenery s{.mesh = patch(0.5)};
  s.state.blend = BlendState{};
  s.state.material.diffuse.a = 0;
  EXPECT_TRUE(s.has(EffectReason::alpha_is_zero));
  s.state.material.diffuse.a = 1 / 255.0f;
  EXPECT_FALSE(s.has(EffectReason::alpha_is_zero));
  s.state.material.diffuse.a = 0;
  s.format.dither = Dither::bayer2;
  EXPECT_FALSE(s.has(EffectReason::alpha_is_zero)) << "dither changes the stored colour";
}

TEST(Elision, LeavesOutAlphaTestsWithOneOutcome) {
  Scenery s{.mesh = patch(0.5)};
  s.state.alpha_test = AlphaTest{Compare::greater, 0.5f};
  EXPECT_TRUE(s.has(EffectReason::every_fragment_passes));
  s.state.material.diffuse.a = 0.5f;
  EXPECT_TRUE(s.has(EffectReason::every_fragment_fails));
  EXPECT_TRUE(s.has(EffectReason::no_pixel_can_change));
  Random random(3);
  s.state.lighting = false;
  set_colors(s.mesh, random, 1);
  s.mesh.colors[3] = 0;
  EXPECT_FALSE(s.has(EffectReason::every_fragment_passes) || s.has(EffectReason::every_fragment_fails));
}

TEST(Elision, LightsEqualNormalsOnce) {
  Scenery s{.mesh = whole_window()};
  for (int i = 0; i < 4; ++i) s.mesh.normals.insert(s.mesh.normals.end(), {0.6f, 0, 0.8f});
  for (const Shading shading : {Shading::flat, Shading::gouraud, Shading::phong}) {
    s.state.shading = shading;
    EXPECT_TRUE(s.has(EffectReason::equal_normals));
    EXPECT_EQ(s.picture(true), s.picture(false));
  }
  s.lights[0].position = {0, 0, 3, 1};
  EXPECT_FALSE(s.has(EffectReason::equal_normals)) << "a point light";
  s.lights[0].position = {0, 0, 1, 0};
  s.mesh.normals[0] = 0.5f;
  EXPECT_FALSE(s.has(EffectReason::equal_normals));
}

TEST(Elision, InterpolatesNoEqualColors) {
  Scenery s{.mesh = whole_window()};
  s.mesh.colors.assign(16, 0.3f);
  s.state.lighting = false;
  EXPECT_TRUE(s.has(EffectReason::equal_colors));
  EXPECT_EQ(s.picture(true), s.picture(false));
  s.mesh.colors[5] = 0.31f;
  EXPECT_FALSE(s.has(EffectReason::equal_colors));
}

// A vertex that is not finite drops its triangles only if its value is read, in full and elided alike.
TEST(Elision, DropsTheSameTrianglesWithValuesThatAreNotFinite) {
  for (const float bad : {std::nanf(""), std::numeric_limits<float>::infinity()}) {
    Scenery s{.mesh = patch(0.6)};
    s.lights[0].position = {0, 0, -1, 0};
    s.mesh.normals[3 * 40] = bad;
    EXPECT_FALSE(s.has(EffectReason::light_behind));
    EXPECT_EQ(s.picture(true), s.picture(false));
    Random random(4);
    Scenery colored{.mesh = patch(0.6)};
    set_colors(colored.mesh, random, 1);
    colored.state.lighting = false;
    colored.state.blend = BlendState{};
    colored.state.alpha_test = AlphaTest{Compare::greater, 0.5f};
    colored.mesh.colors[4 * 40 + 1] = bad;
    EXPECT_EQ(colored.picture(true), colored.picture(false));
    colored.state.color_mask = {false, false, false, false};
    EXPECT_EQ(colored.picture(true), colored.picture(false));
  }
}

TEST(Elision, NamesTheFieldThatDecides) {
  Scenery s{.mesh = patch(0.3)};
  s.state.blend = BlendState{};
  s.lights.resize(3);
  s.lights[2].position = {0, 0, 4, 1};
  s.lights[2].spot_cutoff = 10;
  s.lights[2].spot_direction = {1, 0, -1};
  FrameBuffer buffer(s.format);
  Frame frame(buffer);
  s.record(frame);
  const DrawExplanation explanation = frame.explanation(0);
  const auto cause_of = [&](EffectReason reason) {
    for (const EffectExplanation& effect : explanation.effects)
      if (effect.note.reason == reason) return effect.cause;
    return std::string("not found");
  };
  EXPECT_EQ(cause_of(EffectReason::light_outside_cone), "lights[2].spot_cutoff");
  EXPECT_EQ(cause_of(EffectReason::alpha_is_one), "material.diffuse");
  EXPECT_EQ(cause_of(EffectReason::black_specular), "material.specular");
  EXPECT_EQ(explanation.code_paths.size(), 1u);
  for (const EffectExplanation& effect : explanation.effects)
    EXPECT_FALSE(effect.cause.empty()) << effect.text;
  EXPECT_THAT(frame.explain(0), testing::HasSubstr("light 2: skipped, no point is inside its cone"));
}

}  // namespace
}  // namespace tessera::elision_test
