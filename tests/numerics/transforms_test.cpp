// Draws under degenerate transforms: mirrored objects face as they appear in the window and are lit by the
// inverse transpose; singular transforms yield planes, lines and points; powers of two preserve every bit.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "engine/program/scene/builtin_mesh.h"
#include "tests/numerics/bounds.h"
#include "tests/numerics/random_lit_scenes.h"
#include "tests/raster/random_triangles.h"

namespace tessera::test::transforms_test {
using namespace program;
namespace {

constexpr int kSide = 32;

class Canvas {
 public:
  /// Returns pixels of 8 bits each for red, green and blue, rows from the top.
  std::vector<std::uint32_t> draw(const Mesh& mesh, const DrawState& state, const Camera& camera = {},
                                  const std::vector<Light>& lights = {Light{}},
                                  const LightModel& model = {}) {
    Frame frame(buffer_);
    frame.clear({.color = Color{0, 0, 0, 1}, .depth = 1.0});
    frame.set_camera(camera);
    frame.set_lights(lights);
    frame.set_light_model(model);
    frame.draw(mesh, state);
    std::vector<std::uint32_t> words(kSide * kSide);
    stats = renderer_.finish(frame, {words.data(), kSide, kSide, 4 * kSide, PixelOrder::bgra8});
    for (std::uint32_t& w : words) w &= 0xffffff;
    return words;
  }
  FrameStats stats;

 private:
  FrameBuffer buffer_{FrameBufferFormat{.width = kSide, .height = kSide}};
  Renderer renderer_{RendererOptions{.threads = 1}};
};
/// The pixel to the upper right of the window's centre, which a point at the centre covers.
constexpr std::size_t kMiddle = (kSide / 2 - 1) * kSide + kSide / 2;

DrawState unlit() {
  DrawState state{.lighting = false};
  state.material.diffuse = {1, 1, 1, 1};
  return state;
}
std::size_t drawn(const std::vector<std::uint32_t>& words) {
  return static_cast<std::size_t>(
      std::count_if(words.begin(), words.end(), [](std::uint32_t w) { return w != 0; }));
}

Matrix turn(LightingRng& rng) {
  const std::array<float, 3> axis = rng.direction();
  return rotate(rng.between(0, 360), axis[0], axis[1], axis[2]);
}
Real3 transformed(const Matrix& m, const Real3& v) {
  Real3 r{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k) r[i] += m.m[4 * i + k] * v[k];
  return r;
}
Real3 cross(const Real3& a, const Real3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

// A large triangle around the centre, rotated and stretched, half of the time mirrored. Its normal is the
// inverse transpose applied to the object's normal. The visible side follows from the winding in the window:
// a mirrored triangle has the opposite winding, so its back is visible where its normal faces the eye.
TEST(MirroredDraws, FaceByTheirWindowWindingAndKeepTheirNormals) {
  LightingRng rng{std::mt19937(61)};
  Canvas canvas;
  Real worst = 0;
  int fronts = 0;
  int backs = 0;
  int mirrored = 0;
  for (int n = 0; n < 2000 * (long_tests() ? 30 : 1); ++n) {
    const double x = std::exp2(rng.between(-3, 3)) * (rng.one_in(2) ? -1 : 1);
    const double y = std::exp2(rng.between(-3, 3)) * (rng.one_in(2) ? -1 : 1);
    const Matrix transform = scale(1, 1, 1e-3) * turn(rng) *
                             scale(x, y, std::exp2(rng.between(-3, 3)) * (rng.one_in(2) ? -1 : 1)) *
                             turn(rng);
    const std::array<float, 9> corners{-1, -1, 0, 1, -1, 0, 0, 1.5f, 0};
    Real3 at[3];
    for (std::size_t k = 0; k < 3; ++k)
      at[k] = transformed(transform, {corners[3 * k], corners[3 * k + 1], corners[3 * k + 2]});
    const Real area = cross(at[1] - at[0], at[2] - at[0])[2];
    const Real3 middle{1.0L / kSide, 1.0L / kSide, 0};
    Real inside = 1;  // smallest barycentric coordinate of the centre
    for (std::size_t k = 0; k < 3; ++k)
      inside = std::min(inside, cross(at[(k + 1) % 3] - at[k], middle - at[k])[2] / area);
    if (!(inside > 0.01L) || std::abs(area) < 0.05L) continue;
    // M^-T (0, 0, 1) is m0 x m1 over the determinant: the cross product of the window's edges, reversed by a
    // mirror.
    const Real3 m0 = transformed(transform, {1, 0, 0});
    const Real3 m1 = transformed(transform, {0, 1, 0});
    const Real3 m2 = transformed(transform, {0, 0, 1});
    const bool is_mirrored = dot(m2, cross(m0, m1)) < 0;
    const bool clockwise = rng.one_in(2);
    const bool front = (area > 0) != clockwise;
    const Real3 normal = normalized(cross(m0, m1) * (is_mirrored ? -1 : 1));
    const std::array<float, 3> up{0, 0, 1};
    std::vector<float> normals;
    for (int k = 0; k < 3; ++k) normals.insert(normals.end(), up.begin(), up.end());
    DrawState state{.transform = transform,
                    .shading = rng.of({Shading::flat, Shading::gouraud, Shading::phong}),
                    .depth = {.enabled = false}};
    state.front_face = clockwise ? FrontFace::cw : FrontFace::ccw;
    state.material = {.ambient = {0, 0, 0, 1}, .diffuse = {1, 0, 0.5f, 1}, .emission = {0, 0, 0.25f, 1}};
    state.back_material =
        Material{.ambient = {0, 0, 0, 1}, .diffuse = {0, 1, 0.5f, 1}, .emission = {0, 0, 0.25f, 1}};
    const std::array<float, 3> l = rng.direction();
    const std::vector<Light> lights{Light{.position = {l[0], l[1], l[2], 0}}};
    const LightModel model{.ambient = {0, 0, 0, 1}, .two_sided = true};
    // The depth is scaled down so that the triangle lies in the view volume. The oracle applies the same
    // scale to the normals.
    const std::uint32_t word =
        canvas.draw({.positions = corners, .normals = normals}, state, {}, lights, model)[kMiddle];
    const auto exact = lit_color(front ? state.material : *state.back_material, lights, model, {normal, {}},
                                 kCosineSlack, front);
    for (std::size_t c = 0; c < 3; ++c) {
      const Real level = word >> (16 - 8 * c) & 255;
      update_worst(worst, exact[c].low * 255 - level, level - exact[c].high * 255);
    }
    (front ? fronts : backs) += 1;
    mirrored += is_mirrored;
  }
  EXPECT_TRUE(fronts > 300 && backs > 300 && mirrored > 300) << fronts << " " << backs << " " << mirrored;
  expect_within("lit faces under mirrored transforms", worst, 1, "levels of 255");
}

// A mirrored closed mesh with clockwise front faces shows the same pixels as a mesh with mirrored vertices.
TEST(MirroredDraws, MatchMirroredVerticesUnderClockwiseFronts) {
  Canvas canvas;
  const MeshData teapot = builtin_mesh("teapot", 4);
  std::vector<float> by_hand = teapot.positions;
  for (std::size_t i = 0; i < by_hand.size(); i += 3) by_hand[i] = -by_hand[i];
  DrawState state = unlit();
  state.cull = Cull::back;
  state.front_face = FrontFace::cw;
  const Camera camera{.view = rotate(30, 1, 1, 0), .projection = orthographic(-1, 1, -1, 1, -8, 8)};
  const auto expected = canvas.draw({.positions = by_hand, .indices = teapot.indices}, state, camera);
  const std::uint64_t culled = canvas.stats.culled;
  state.transform = scale(-1, 1, 1);
  EXPECT_EQ(canvas.draw({.positions = teapot.positions, .indices = teapot.indices}, state, camera), expected);
  EXPECT_EQ(canvas.stats.culled, culled);
  EXPECT_GT(drawn(expected), 100u);
}

// An object scaled by a power of two under the inverse transform: every bit of the picture is the same.
TEST(ScaledTransforms, PowersOfTwoPreserveEveryBit) {
  Canvas canvas;
  const MeshData teapot = builtin_mesh("teapot", 4);
  const Camera camera{.view = look_at({0, 1, 4}, {0, 0, 0}, {0, 1, 0}),
                      .projection = perspective(30, 1, 1, 100)};
  for (const Shading shading : {Shading::flat, Shading::gouraud, Shading::phong})
    for (const bool normalize : {true, false}) {
      DrawState state{.shading = shading, .normalize = normalize};
      state.material = *named_material("gold");
      const std::vector<Light> lights{Light{.position = {5, 5, 5, 1}}};
      const auto expected =
          canvas.draw({.positions = teapot.positions, .normals = teapot.normals, .indices = teapot.indices},
                      state, camera, lights);
      EXPECT_GT(drawn(expected), 50u);
      for (const int exponent : {-100, -20, 20, 100}) {
        std::vector<float> positions, normals;
        for (const float p : teapot.positions) positions.push_back(std::ldexp(p, exponent));
        for (const float n : teapot.normals) normals.push_back(std::ldexp(n, -exponent));
        const double back = std::ldexp(1.0, -exponent);
        state.transform = scale(back, back, back);
        EXPECT_EQ(canvas.draw({.positions = positions, .normals = normals, .indices = teapot.indices}, state,
                              camera, lights),
                  expected)
            << exponent;
        // Also with unscaled normals, where the engine normalizes them.
        if (!normalize && shading != Shading::phong) continue;
        const Camera scaled{.view = camera.view, .projection = camera.projection * scale(1, 1, 1)};
        EXPECT_EQ(canvas.draw({.positions = positions, .normals = teapot.normals, .indices = teapot.indices},
                              state, scaled, lights),
                  expected)
            << exponent;
      }
    }
}

// An axis of length 0 gives the same picture as positions without that coordinate.
TEST(SingularTransforms, DrawTheProjectedGeometry) {
  Canvas canvas;
  const std::vector<float> corners{-0.8f, -0.7f, 0.3f, 0.9f, -0.5f, 0.6f, 0.1f, 0.8f, -0.9f};
  for (const std::array<double, 3>& axes :
       {std::array{1.0, 1.0, 0.0}, std::array{1.0, 0.0, 1.0}, std::array{0.0, 1.0, 1.0},
        std::array{1.0, 0.0, 0.0}, std::array{0.0, 0.0, 0.0}}) {
    std::vector<float> flat = corners;
    for (std::size_t i = 0; i < flat.size(); ++i) flat[i] *= static_cast<float>(axes[i % 3]);
    for (const Primitive primitive : {Primitive::triangles, Primitive::line_loop, Primitive::points}) {
      DrawState state = unlit();
      const auto expected = canvas.draw({.primitive = primitive, .positions = flat}, state);
      state.transform = scale(axes[0], axes[1], axes[2]);
      EXPECT_EQ(canvas.draw({.primitive = primitive, .positions = corners}, state), expected);
      const bool has_area = axes[0] != 0 && axes[1] != 0;
      if (primitive == Primitive::triangles) {
        EXPECT_EQ(drawn(expected) > 0, has_area);
        EXPECT_EQ(canvas.stats.zero_area + canvas.stats.trivially_rejected, has_area ? 0u : 1u);
      }
      EXPECT_TRUE(primitive != Primitive::points || drawn(expected) > 0);
    }
  }
}

// Lighting under singular and huge transforms: no NaN removes the ambient part.
TEST(SingularTransforms, KeepTheAmbientPart) {
  LightingRng rng{std::mt19937(62)};
  Canvas canvas;
  const std::vector<float> origin{0, 0, 0};
  const std::vector<Light> lights{Light{.ambient = {0.5f, 0.5f, 0.5f, 1}},
                                  Light{.position = {1, 2, 3, 1}, .attenuation_linear = 1}};
  for (int n = 0; n < 2000 * (long_tests() ? 30 : 1); ++n) {
    Matrix transform;
    for (std::size_t i = 0; i < 12; ++i)
      if (i % 4 != 3)
        transform.m[i] =
            rng.one_in(2) ? 0 : rng.of({1.0, -1.0, 1e-300, 1e300, 1e-160, 1e160, 1e20, rng.unit()});
    const std::array<float, 3> normal = rng.one_in(4) ? std::array<float, 3>{0, 0, 3e38f} : rng.direction();
    DrawState state{.transform = transform,
                    .shading = rng.of({Shading::flat, Shading::gouraud, Shading::phong}),
                    .normalize = rng.one_in(2),
                    .depth = {.enabled = false}};
    state.material = {.ambient = {1, 1, 1, 1}, .specular = {1, 1, 1, 1}, .shininess = 3};
    const LightModel model{.ambient = {0, 0, 0, 1},
                           .local_viewer = rng.one_in(2),
                           .specular = rng.of({SpecularModel::blinn, SpecularModel::phong})};
    const std::uint32_t word =
        canvas.draw({.primitive = Primitive::points, .positions = origin, .normals = normal}, state, {},
                    lights, model)[kMiddle];
    ASSERT_GE(word & 255, 128u) << n;
  }
}

// Degenerate projections: every vertex is behind the eye, and nothing is drawn.
TEST(SingularTransforms, DegenerateProjectionsDrawNothing) {
  Canvas canvas;
  const MeshData teapot = builtin_mesh("teapot", 2);
  Matrix nothing;
  Matrix no_w = scale(1, 1, 1);
  nothing.m.fill(0);
  no_w.m[15] = 0;
  for (const Matrix& projection : {nothing, no_w}) {
    const auto words = canvas.draw({.positions = teapot.positions, .indices = teapot.indices}, unlit(),
                                   {.view = {}, .projection = projection});
    EXPECT_EQ(drawn(words), 0u);
  }
}

}  // namespace
}  // namespace tessera::test::transforms_test
