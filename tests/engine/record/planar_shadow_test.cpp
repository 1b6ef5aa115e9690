// Planar shadows: the matrix compared with its geometry, and a shadow draw compared with a mesh that was
// flattened by hand.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/engine/frame/pixel_support.h"

namespace tessera::planar_shadow_test {
namespace {

using namespace test;
using testing::AllOf;
using testing::HasSubstr;
using Plane = std::array<double, 4>;
using Point = std::array<double, 4>;

Light light_at(float x, float y, float z, float w) {
  Light light;
  light.position = {x, y, z, w};
  return light;
}
Point product(const Matrix& m, const Point& p) {
  Point out{};
  for (std::size_t row = 0; row < 4; ++row)
    for (std::size_t column = 0; column < 4; ++column) out[row] += m.m[4 * row + column] * p[column];
  return out;
}
double dot(const Plane& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3]; }

// Intersection of the plane with the line from the light through the point: point + t * direction, solved for
// t.
std::array<double, 3> cast(const Plane& plane, const Light& light, const Point& p) {
  std::array<double, 3> direction;
  for (std::size_t i = 0; i < 3; ++i)
    direction[i] = light.position[3] == 0 ? -double{light.position[i]}
                                          : p[i] - double{light.position[i]} / light.position[3];
  const double t =
      -dot(plane, p) / (plane[0] * direction[0] + plane[1] * direction[1] + plane[2] * direction[2]);
  return {p[0] + t * direction[0], p[1] + t * direction[1], p[2] + t * direction[2]};
}

TEST(PlanarShadow, FallsWhereTheLineFromTheLightMeetsThePlane) {
  Random random(17);
  for (int turn = 0; turn < 3000; ++turn) {
    const auto any = [&] { return random.between(-5, 5); };
    const Plane plane{any(), any(), any(), any()};
    const float w = turn % 3 == 2 ? any() : static_cast<float>(turn % 3);  // direction, point, scaled point
    const Light light = light_at(any(), any(), any(), w);
    const Point l{light.position[0], light.position[1], light.position[2], light.position[3]};
    if (std::abs(dot(plane, l)) < 0.1 || (w != 0 && std::abs(w) < 0.1)) continue;
    const Matrix m = planar_shadow(plane, light);
    // A point between plane and light: on the light's side, and no farther away than the light.
    Point p{any(), any(), any(), 1};
    const double side = w == 0 ? dot(plane, l) : dot(plane, l) / w;
    const double distance = dot(plane, p);
    const double ratio = distance / side;
    const bool between = w == 0 ? ratio > 0 : ratio > 0 && ratio < 0.98;
    const Point shadow = product(m, p);
    if (between) {
      EXPECT_GT(shadow[3], 0) << "clipping keeps the shadow";
      const auto expected = cast(plane, light, p);
      for (std::size_t i = 0; i < 3; ++i)
        EXPECT_NEAR(shadow[i] / shadow[3], expected[i],
                    1e-9 * (1 + std::abs(expected[i])) / std::min(1.0, shadow[3]))
            << turn;
    } else if (w != 0 && ratio > 1.02) {
      EXPECT_LT(shadow[3], 0) << "beyond the light there is no shadow";
    }
    const double length =
        std::abs(shadow[0]) + std::abs(shadow[1]) + std::abs(shadow[2]) + std::abs(shadow[3]);
    EXPECT_NEAR(dot(plane, shadow) / length, 0, 1e-11) << "the shadow lies in the plane";
  }
}

// A plane has many equations.
TEST(PlanarShadow, DoesNotDependOnTheNormalsSignOrLength) {
  const Plane plane{0.25, 1, -0.5, 0.75};
  for (const Light& light : {light_at(1, 4, 2, 1), light_at(1, 3, -2, 0), light_at(-2, -8, -4, -2)}) {
    const Matrix m = planar_shadow(plane, light);
    for (const double factor : {-1.0, 2.0, -0.125, 0x1p600, -0x1p-600}) {
      Plane scaled = plane;
      for (double& v : scaled) v *= factor;
      EXPECT_EQ(planar_shadow(scaled, light).m, m.m) << factor;
    }
  }
}

// The explicit matrix for light that travels in the direction (dx, dy, dz), away from its source.
TEST(PlanarShadow, MatchesTheFormulaForADirection) {
  const double a = 0.5, b = 2, c = -1, d = 3;
  const double dx = -1, dy = -4, dz = 0.5;
  const double weight = a * dx + b * dy + c * dz;
  const double rows[4][4] = {{b * dy + c * dz, -b * dx, -c * dx, -d * dx},
                             {-a * dy, a * dx + c * dz, -c * dy, -d * dy},
                             {-a * dz, -b * dz, a * dx + b * dy, -d * dz},
                             {0, 0, 0, weight}};
  const Matrix m = planar_shadow({a, b, c, d}, light_at(1, 4, -0.5f, 0));
  for (std::size_t i = 0; i < 16; ++i) EXPECT_NEAR(m.m[i], rows[i / 4][i % 4] / weight, 1e-15) << i;
}

MeshData random_caster(Random& random) {
  MeshData mesh;
  // Multiples of 1/64 with heights below 2: flattening by hand does not round.
  for (int i = 0; i < 60; ++i) {
    const auto multiple = [&](int low, int high) {
      return static_cast<float>(low + below(random, high - low)) / 64;
    };
    mesh.positions.insert(mesh.positions.end(), {multiple(-100, 100), multiple(0, 128), multiple(-100, 100)});
    for (int c = 0; c < 4; ++c) mesh.colors.push_back(random.between(0, 1));
    for (int c = 0; c < 3; ++c) mesh.normals.push_back(random.between(-1, 1));
    mesh.color_indices.push_back(random.between(0, 15));
  }
  return mesh;
}

TEST(PlanarShadow, EqualsTheFlattenedMeshInOneColor) {
  const std::uint8_t texel[4] = {200, 90, 30, 60};
  const Texture texture({.pixels = texel, .width = 1, .height = 1}, {.min = TextureFilter::linear});
  for (const FrameBufferFormat& format : operation_formats())
    for (int turn = 0; turn < 24; ++turn) {
      Random random(900 + static_cast<std::uint64_t>(turn));
      const MeshData caster = random_caster(random);
      // Onto y = 0: straight down, or at a slant of half the height, from the second of three lights.
      const float slant = turn % 2 == 0 ? 0.0f : 0.5f;
      const std::vector<Light> lights{light_at(1, 0, 0, 0), light_at(-2 * slant, 2, 0, 0),
                                      light_at(0, 0, 1, 0)};
      MeshData flat;
      for (std::size_t v = 0; v < caster.positions.size(); v += 3) {
        const float* const p = &caster.positions[v];
        flat.positions.insert(flat.positions.end(), {p[0] + slant * p[1], 0, p[2]});
      }
      const Color color{random.between(0, 1), random.between(0, 1), random.between(0, 1),
                        random.between(0, 1)};
      DrawState state = draw_state(random_fragment_state(random, format, turn));
      state.cull = static_cast<Cull>(turn % 3);
      if (format.depth != DepthFormat::none) state.polygon_offset = {-1, -4};
      DrawState shadow = state;
      shadow.shadow_on = ShadowOn{.plane = {0, turn % 4 < 2 ? 2.0 : -0.5, 0, 0}, .light = 1, .color = color};
      shadow.shading = static_cast<Shading>(turn % 3);
      shadow.lighting = turn % 5 != 0;
      shadow.color_material = ColorMaterial::ambient_and_diffuse;
      shadow.material.index_ramp = {{1, 5, 9}};
      shadow.texture = &texture;
      state.lighting = false;
      state.material.diffuse = color;
      FrameBuffer by_shadow(format);
      FrameBuffer by_hand(format);
      const auto draw = [&](FrameBuffer& buffer, const MeshData& mesh, const DrawState& how) {
        Frame frame(buffer);
        draw_background(frame, format);
        frame.set_lights(lights);
        frame.set_light_model({.two_sided = true});
        frame.set_camera(
            {.view = look_at({0, 4, 3}, {0, 0, 0}, {0, 1, 0}), .projection = perspective(45, 1.4, 1, 10)});
        frame.draw(mesh.view(), how);
        Renderer({.threads = 1}).finish(frame);
      };
      draw(by_shadow, caster, shadow);
      draw(by_hand, flat, state);
      EXPECT_EQ(fingerprint(by_shadow), fingerprint(by_hand)) << "turn " << turn << ", " << describe(format);
    }
}

// A square at half the light's height has a shadow twice as large.
TEST(PlanarShadow, GrowsWithTheDistanceFromAPointLight) {
  FrameBuffer buffer({.width = 64, .height = 64});
  Frame frame(buffer);
  frame.clear({.color = Color{1, 1, 1, 1}, .depth = 1.0});
  frame.set_lights({light_at(0, 0, 4, 1)});
  frame.set_camera({.projection = orthographic(-4, 4, -4, 4, -4, 4)});
  const MeshData square = rectangle(-1, -0.5f, 1, 0.5f, 2);
  frame.draw(square.view(), {.shadow_on = ShadowOn{.plane = {0, 0, 1, 0}}});
  EXPECT_THAT(frame.explain(0),
              AllOf(HasSubstr("planar shadow"), HasSubstr("unlit"), HasSubstr("one colour for the draw")));
  Renderer({.threads = 1}).finish(frame);
  const std::vector<std::uint32_t> words = packed_colors(buffer);
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) {
      const bool is_in_shadow = x >= 16 && x < 48 && y >= 24 && y < 40;
      EXPECT_EQ(words[static_cast<std::size_t>(64 * y + x)], is_in_shadow ? 0u : 0xffffffu) << x << ' ' << y;
    }
}

// The object's transform applies first, then the shadow in world space.
TEST(PlanarShadow, FollowsTheObjectsTransform) {
  FrameBuffer a({.width = 64, .height = 64}), b({.width = 64, .height = 64});
  const MeshData square = rectangle(-0.5f, -0.5f, 0.5f, 0.5f);
  const MeshData moved = rectangle(0.5f, 0, 1.5f, 1, 1);
  for (const bool transformed : {true, false}) {
    FrameBuffer& buffer = transformed ? a : b;
    Frame frame(buffer);
    frame.clear({.color = Color{1, 1, 1, 1}, .depth = 1.0});
    frame.set_lights({light_at(1, 0, 1, 0)});
    frame.set_camera({.view = rotate(30, 0, 0, 1), .projection = orthographic(-4, 4, -4, 4, -4, 4)});
    DrawState state;
    if (transformed) state.transform = translate(1, 0.5, 1);
    state.shadow_on = ShadowOn{.plane = {0, 0, 1, 1}, .color = {1, 0, 0, 1}};
    frame.draw((transformed ? square : moved).view(), state);
    Renderer({.threads = 1}).finish(frame);
  }
  EXPECT_EQ(fingerprint(a), fingerprint(b));
  EXPECT_THAT(packed_colors(a), testing::Contains(0xff0000u));
}

TEST(PlanarShadow, DegenerateShadowsAreRefused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const MeshData square = rectangle(-1, -1, 1, 1);
  FrameBuffer buffer({.width = 8, .height = 8});
  const auto error_with = [&](const std::vector<Light>& lights, const ShadowOn& shadow) {
    Frame frame(buffer);
    frame.set_lights(lights);
    const auto message = error_of([&] { frame.draw(square.view(), {.shadow_on = shadow}); });
    EXPECT_EQ(frame.draw_count(), message ? 0u : 1u);
    return message.value_or("(no error)");
  };
  const std::vector<Light> two{light_at(0, 1, 0, 0), light_at(1, 2, 3, 1)};
  EXPECT_EQ(error_with(two, {.plane = {0, 1, 0, 0}}), "(no error)");
  EXPECT_THAT(error_with(two, {.plane = {0, 0, 0, 5}}),
              HasSubstr("Frame::draw: shadow_on: the plane is 0 0 0 5, its normal must not be 0 0 0"));
  EXPECT_THAT(error_with(two, {.plane = {0, nan, 0, 5}}),
              HasSubstr("Frame::draw: shadow_on's plane holds nan, must be finite"));
  EXPECT_THAT(error_with(two, {.plane = {0, 1, 0, 0}, .light = 2}),
              HasSubstr("Frame::draw: shadow_on.light is 2, the frame has 2 lights, counted from 0"));
  EXPECT_THAT(error_with({}, {.plane = {0, 1, 0, 0}}),
              HasSubstr("shadow_on.light is 0, the frame has 0 lights"));
  EXPECT_THAT(
      error_with(two, {.plane = {1, 0, 0, 2}}),
      HasSubstr("Frame::draw: shadow_on: the light's direction 0 1 0 is parallel to the plane 1 0 0 2"));
  EXPECT_THAT(error_with(two, {.plane = {0, 0, 2, -6}, .light = 1}),
              HasSubstr("Frame::draw: shadow_on: the light at 1 2 3 lies in the plane 0 0 2 -6"));
  EXPECT_THAT(error_with(two, {.plane = {0, 1, 0, 0}, .color = {0, 0, static_cast<float>(nan), 1}}),
              HasSubstr("shadow_on.color holds nan"));
  // At the limit of rounding, and beyond it.
  EXPECT_THAT(error_with({light_at(0.1f, 0.2f, 0.3f, 1)},
                         {.plane = {1, 1, 1, -(double{0.1f} + 0.2f + 0.3f) - 1e-14}}),
              HasSubstr("lies in the plane"));
  EXPECT_THAT(error_with({light_at(0.1f, 0.2f, 0.3f, 1)}, {.plane = {1, 1, 1, -0.6}}),
              HasSubstr("lies in the plane"));
  EXPECT_THAT(error_with({light_at(0.6f, 0.8f, 0, 0)}, {.plane = {0.8, -0.6, 0, 0}}), HasSubstr("parallel"));
  EXPECT_EQ(
      error_with({light_at(0.1f, 0.2f, 0.3f, 1)}, {.plane = {1, 1, 1, -(double{0.1f} + 0.2f + 0.3f) - 1e-5}}),
      "(no error)");
  EXPECT_THAT(error_with({light_at(1, 0, 0, 0)}, {.plane = {1e-300, 0, 0, 1e10}}), HasSubstr("too far away"));
  EXPECT_THAT(error_with({light_at(0, 0, 0, 0)}, {.plane = {0, 1, 0, 0}}), HasSubstr("parallel"));
  EXPECT_THAT(error_of([&] {
                planar_shadow({0, 0, 0, 0}, Light{});
              }).value_or(""),
              HasSubstr("planar_shadow: the plane is 0 0 0 0"));
  const Light nowhere = light_at(static_cast<float>(nan), 0, 0, 1);
  EXPECT_THAT(error_of([&] {
                planar_shadow({0, 0, 1, 0}, nowhere);
              }).value_or(""),
              HasSubstr("planar_shadow's light's position holds nan"));
  const double huge = std::numeric_limits<double>::max();
  const double tiny = std::numeric_limits<double>::denorm_min();
  EXPECT_FALSE(error_of([&] { planar_shadow({0, 0, huge, -huge}, light_at(0, 0, 3e38f, 1)); }));
  EXPECT_FALSE(error_of([&] { planar_shadow({0, tiny, 0, 0}, light_at(0, 1, 0, 0)); }));
}

}  // namespace
}  // namespace tessera::planar_shadow_test
