// Parts of a model's scene that follow its camera: the order of triangles that blend, and the light.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <variant>
#include <vector>

#include "engine/program/scene/follow_camera.h"
#include "engine/program/scene/model_scene.h"
#include "tests/engine/program/import/model_picture.h"

namespace tessera::follow_camera_test {
using namespace program;
namespace {

constexpr float kAlpha = 0.5f;

/// Squares that face z, each with a separate material, at given places.
Model panes(const std::vector<float>& places, const std::vector<Color>& colors) {
  Model model;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto first = static_cast<std::uint32_t>(model.mesh.vertex_count());
    for (const auto& [x, y] : {std::pair(-1, -1), {1, -1}, {1, 1}, {-1, 1}}) {
      model.mesh.positions.insert(model.mesh.positions.end(),
                                  {static_cast<float>(x), static_cast<float>(y), places[i]});
      model.mesh.normals.insert(model.mesh.normals.end(), {0, 0, 1});
    }
    ModelPart part;
    part.first_index = model.mesh.indices.size();
    part.index_count = 6;
    part.is_unlit = true;
    part.material.diffuse = colors[i];
    part.alpha = ModelAlpha::blend;
    for (const std::uint32_t corner : {0u, 1u, 2u, 0u, 2u, 3u}) model.mesh.indices.push_back(first + corner);
    model.parts.push_back(part);
  }
  return model;
}

SceneCamera camera_at(double z) {
  return {.view = look_at({0, 0, z}, {0, 0, 0}, {0, 1, 0}),
          .projection = Lens{.fovy = 10, .near = 1, .far = 100}};
}

/// The colour in the middle, seen from a place on the z axis.
model_picture::Pixel center_from(double z, Scene scene) {
  apply({.camera = camera_at(z)}, scene);
  return model_picture::pixel(model_picture::draw(scene), scene.framebuffer.width / 2,
                              scene.framebuffer.height / 2);
}

TEST(FollowCamera, BlendedPartsAreDrawnFromBackToFront) {
  const Color red{1, 0, 0, kAlpha}, green{0, 1, 0, kAlpha}, blue{0, 0, 1, kAlpha};
  const Scene scene = model_scene(panes({1, 0, 2}, {green, red, blue}), "panes", 64, 48);
  // Source over, three times: 1/2 for the nearest, 1/4, 1/8, and 1/8 of the background.
  const auto expect_near = [](model_picture::Pixel found, double r, double g, double b) {
    EXPECT_NEAR(found[0], 255 * r + model_picture::kBackground[0] / 8.0, 2);
    EXPECT_NEAR(found[1], 255 * g + model_picture::kBackground[1] / 8.0, 2);
    EXPECT_NEAR(found[2], 255 * b + model_picture::kBackground[2] / 8.0, 2);
  };
  expect_near(center_from(30, scene), 1 / 8.0, 1 / 4.0, 1 / 2.0);   // blue is in front
  expect_near(center_from(-30, scene), 1 / 2.0, 1 / 4.0, 1 / 8.0);  // red is in front
}

TEST(FollowCamera, TrianglesOfOneMaterialAreOneDrawWhereTheyFollowEachOther) {
  const Color red{1, 0, 0, kAlpha}, green{0, 1, 0, kAlpha};
  Scene scene = model_scene(panes({0, 1, 2, 3}, {red, red, green, green}), "panes", 64, 48);
  apply({.camera = camera_at(30)}, scene);
  int draws = 0;
  std::size_t next = 0;
  for (const SceneCommand& command : scene.frame)
    if (const auto* draw = std::get_if<DrawCommand>(&command.value)) {
      ++draws;
      EXPECT_EQ(draw->first_index, next);
      next += draw->index_count;
      EXPECT_FALSE(draw->state.depth.write);
    }
  EXPECT_EQ(next, 24u);
  EXPECT_LE(draws, 4);
  EXPECT_GE(draws, 2);
}

TEST(FollowCamera, SortsManyTrianglesByDistance) {
  std::mt19937 random(5);
  std::vector<float> places;
  for (int i = 0; i < 200; ++i) places.push_back(static_cast<float>(random() % 1000) / 100);
  Scene scene =
      model_scene(panes(places, std::vector<Color>(places.size(), Color{1, 1, 1, kAlpha})), "panes", 64, 48);
  apply({.camera = camera_at(-40)}, scene);
  const MeshData& mesh = scene.meshes[scene.blended->mesh];
  ASSERT_EQ(mesh.indices.size(), 6 * places.size());
  float last = 1e9f;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    const float z = mesh.positions[3 * std::size_t{mesh.indices[i]} + 2];  // far ones first, seen along +z
    EXPECT_LE(z, last);
    last = z;
  }
}

TEST(FollowCamera, OpaquePartsAreDrawnFirstAndHideWhatIsBehind) {
  Model model = panes({0, 1}, {Color{1, 0, 0, kAlpha}, Color{0, 0, 1, 1}});
  model.parts[1].alpha = ModelAlpha::opaque;
  const Scene scene = model_scene(model, "panes", 64, 48);
  EXPECT_EQ(center_from(30, scene), (model_picture::Pixel{0, 0, 255}));
  const model_picture::Pixel behind = center_from(-30, scene);
  EXPECT_NEAR(behind[0], 127.5, 1);
  EXPECT_NEAR(behind[2], 127.5, 1);
}

TEST(FollowCamera, InvisiblePartsHideNothing) {
  Model model = panes({0, 1}, {Color{1, 0, 0, 1}, Color{0, 0, 1, 0}});
  model.parts[0].alpha = ModelAlpha::opaque;
  EXPECT_EQ(center_from(30, model_scene(model, "panes", 64, 48)), (model_picture::Pixel{255, 0, 0}));
}

TEST(FollowCamera, PartsThatBlendWithoutAlphaAreOpaque) {
  const Scene scene = model_scene(panes({0}, {Color{1, 0, 0, 1}}), "panes", 64, 48);
  EXPECT_FALSE(scene.blended.has_value());
}

TEST(FollowCamera, LightStaysOverTheShoulder) {
  Scene scene = model_scene(panes({0}, {Color{1, 0, 0, 1}}), "panes", 64, 48);
  ASSERT_TRUE(scene.has_shoulder_light);
  std::vector<std::vector<double>> seen;  // the direction of the light, in eye space
  for (const Vec3 eye : {Vec3{0, 0, 9}, Vec3{5, 3, -8}, Vec3{-9, 0, 1}}) {
    apply({.camera = SceneCamera{.view = look_at(eye, {0, 0, 0}, {0, 1, 0}), .projection = Lens{}}}, scene);
    ASSERT_EQ(scene.lights.size(), 1u);
    const Matrix& view = scene.camera.view;
    std::vector<double>& at = seen.emplace_back();
    for (std::size_t row = 0; row < 3; ++row) {
      double sum = 0;
      for (std::size_t k = 0; k < 3; ++k)
        sum += view.m[4 * row + k] * static_cast<double>(scene.lights[0].position[k]);
      at.push_back(sum);
    }
    EXPECT_LT(at[0], 0);  // left
    EXPECT_GT(at[1], 0);  // above
    EXPECT_GT(at[2], 0);  // from the viewer's side
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(at[k], seen[0][k], 1e-6);
  }
}

TEST(FollowCamera, GivenLightsReplaceTheOneOverTheShoulder) {
  Scene scene = model_scene(panes({0}, {Color{1, 0, 0, 1}}), "panes", 64, 48);
  apply({.camera = camera_at(-20), .lights = {Light{.position = {0, 1, 0, 0}}}}, scene);
  ASSERT_EQ(scene.lights.size(), 1u);
  EXPECT_EQ(scene.lights[0].position, (std::array<float, 4>{0, 1, 0, 0}));
}

TEST(FollowCamera, UnlitPartsKeepTheirColorBesideVertexColors) {
  const Color red{1, 0, 0, kAlpha}, green{0, 1, 0, kAlpha};
  Model model = panes({0, 1}, {red, green});
  const model_picture::Pixel plain = center_from(20, model_scene(model, "panes", 64, 48));
  // The same green as vertex colours.
  model.mesh.colors.assign(16, 0);
  for (int i = 0; i < 4; ++i) model.mesh.colors.insert(model.mesh.colors.end(), {0, 1, 0, kAlpha});
  model.parts[1].uses_colors = true;
  EXPECT_EQ(center_from(20, model_scene(model, "panes", 64, 48)), plain);
}

TEST(FollowCamera, KeepsTheShadingThatIsSetWithACamera) {
  Scene scene = model_scene(panes({0, 1}, {{1, 0, 0, kAlpha}, {0, 1, 0, kAlpha}}), "panes");
  apply({.shading = Shading::flat, .camera = camera_at(20)}, scene);
  for (const SceneCommand& command : scene.frame) {
    const auto* draw = std::get_if<DrawCommand>(&command.value);
    EXPECT_TRUE(draw == nullptr || draw->state.shading == Shading::flat);
  }
}

}  // namespace
}  // namespace tessera::follow_camera_test
