// Defaults of scene files, the keys they read, and overrides.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "engine/program/scene/scene.h"

namespace tessera::scene_defaults_test {
using namespace program;
namespace {

Scene parse(const std::string& keys) {
  return parse_scene("{\"tessera\": 1" + (keys.empty() ? "" : ", " + keys) + "}", "test.json");
}
const DrawCommand& draw_of(const Scene& scene, std::size_t i) {
  return std::get<DrawCommand>(scene.frame.at(i).value);
}
const Clear& clear_of(const Scene& scene, std::size_t i) { return std::get<Clear>(scene.frame.at(i).value); }
bool same(const Matrix& a, const Matrix& b) { return a.m == b.m; }
bool same(Color a, Color b) { return a.r == b.r && a.g == b.g && a.b == b.b && a.a == b.a; }

TEST(SceneDefaults, EmptySceneClearsBuffers) {
  const Scene scene = parse("");
  EXPECT_EQ(scene.framebuffer.width, 640);
  EXPECT_EQ(scene.framebuffer.height, 480);
  EXPECT_EQ(scene.framebuffer.color_mode, ColorMode::rgb);
  EXPECT_EQ(scene.framebuffer.color_bits, 24);
  EXPECT_EQ(scene.framebuffer.depth, DepthFormat::unorm24);
  EXPECT_EQ(scene.framebuffer.stencil_bits, 8);
  EXPECT_TRUE(same(scene.camera.view, look_at({0, 0, 4}, {0, 0, 0}, {0, 1, 0})));
  EXPECT_TRUE(same(scene.camera.at_aspect(2).projection, perspective(45, 2, 0.1, 100)));
  EXPECT_EQ(scene.lights.size(), 1u);
  EXPECT_FALSE(scene.light_model.local_viewer);
  ASSERT_EQ(scene.frame.size(), 1u);
  EXPECT_TRUE(same(*clear_of(scene, 0).color, {0, 0, 0, 1}));
  EXPECT_EQ(clear_of(scene, 0).depth, 1.0);
  EXPECT_EQ(clear_of(scene, 0).stencil, 0u);
}

TEST(SceneDefaults, DefaultFrameDrawsMeshesInFileOrder) {
  const Scene scene = parse(
      R"("meshes": {"z": {"builtin": "cube"}, "a": {"builtin": "quad"}, "m": {"builtin": "grid",
    "detail": 2}})");
  ASSERT_EQ(scene.frame.size(), 4u);
  EXPECT_EQ(scene.meshes[draw_of(scene, 1).mesh].name, "z");
  EXPECT_EQ(scene.meshes[draw_of(scene, 2).mesh].name, "a");
  EXPECT_EQ(scene.meshes[draw_of(scene, 3).mesh].name, "m");
  const DrawState& state = draw_of(scene, 1).state;
  EXPECT_EQ(state.shading, Shading::gouraud);
  EXPECT_TRUE(state.lighting && state.normalize && state.depth.enabled && state.depth.write);
  EXPECT_EQ(state.depth.test, Compare::less);
}

TEST(SceneDefaults, ReversedProjectionReversesDefaultFrame) {
  const Scene scene = parse(
      R"("meshes": {"m": {"builtin": "cube"}}, "camera": {"projection": {"reversed": true,
    "far": "infinity"}})");
  EXPECT_TRUE(scene.camera.reversed);
  EXPECT_EQ(std::get<Lens>(scene.camera.projection).far, std::numeric_limits<double>::infinity());
  EXPECT_EQ(clear_of(scene, 0).depth, 0.0);
  EXPECT_EQ(draw_of(scene, 1).state.depth.test, Compare::greater);
}

TEST(SceneDefaults, DefaultFrameSkipsMissingDepthAndStencil) {
  const Scene scene =
      parse(R"("framebuffer": {"depth": "none", "stencil": 0}, "meshes": {"m": {"builtin": "cube"}})");
  EXPECT_FALSE(clear_of(scene, 0).depth);
  EXPECT_FALSE(clear_of(scene, 0).stencil);
  EXPECT_FALSE(draw_of(scene, 1).state.depth.enabled);
  const Scene written = parse(
      R"("framebuffer": {"depth": "none"}, "meshes": {"m": {"builtin": "cube"}}, "frame": [{"draw": "m"},
    {"draw": "m", "depth": false}])");
  EXPECT_FALSE(draw_of(written, 0).state.depth.enabled);
  EXPECT_FALSE(draw_of(written, 1).state.depth.enabled);
}

TEST(SceneDefaults, EmptyLightListMeansNoLights) {
  EXPECT_TRUE(parse(R"("lights": [])").lights.empty());
  const Scene scene =
      parse(R"("lights": [{}, {"position": [1, 2, 3, 1], "spot_cutoff": 30, "attenuation": [0, 1, 2]}])");
  ASSERT_EQ(scene.lights.size(), 2u);
  EXPECT_EQ(scene.lights[0].spot_cutoff, 180);
  EXPECT_EQ(scene.lights[1].position[1], 2);
  EXPECT_EQ(scene.lights[1].attenuation_quadratic, 2);
}

TEST(SceneDefaults, AcceptsUnsupportedKeysAtTheirDefaults) {
  const Scene scene = parse(R"(
    "framebuffer": {"dither": "none", "alpha": 0, "accumulation": 0, "samples": 1}, "textures": {},
      // a comment
    "meshes": {"m": {"builtin": "cube", "detail": 1}},
    "frame": [{"draw": "m", "polygon_mode": "fill", "point_size": 1, "line_width": 1.0,
    "polygon_offset": [0, 0], "texture_env": "modulate",
               "texture_env_color": [0, 0, 0, 0], "logic_op": "copy", "stages": []},
              /* another */ {"draw": "m", "polygon_mode": ["fill", "fill"]}])");
  EXPECT_EQ(scene.frame.size(), 2u);
}

TEST(SceneDefaults, ReadsAllKeysOfAccum) {
  const Scene scene = parse(R"(
    "framebuffer": {"accumulation": 32},
    "frame": [{"clear": {"accumulation": [0.5, -0.25, 0, -1]}}, {"accum": {"op": "mult", "value": -0.1}},
              {"accum": {"op": "return", "value": 2, "scissor": [1, 2, 3, 4], "color_mask": [true, false,
    true, false]}}])");
  EXPECT_EQ(scene.framebuffer.accumulation_bits, 32);
  EXPECT_TRUE(same(*std::get<Clear>(scene.frame[0].value).accumulation, {0.5f, -0.25f, 0, -1}));
  const auto& mult = std::get<Accum>(scene.frame[1].value);
  EXPECT_EQ(mult.op, AccumOp::mult);
  EXPECT_EQ(mult.value, -0.1);
  EXPECT_FALSE(mult.scissor);
  EXPECT_EQ(mult.color_mask, (std::array<bool, 4>{true, true, true, true}));
  const auto& returned = std::get<Accum>(scene.frame[2].value);
  EXPECT_EQ(returned.op, AccumOp::return_color);
  ASSERT_TRUE(returned.scissor);
  EXPECT_EQ(returned.scissor->height, 4);
  EXPECT_EQ(returned.color_mask, (std::array<bool, 4>{true, false, true, false}));
}

TEST(SceneDefaults, ReadsAllKeysOfDraw) {
  const Scene scene = parse(R"(
    "meshes": {"m": {"builtin": "cube", "detail": 1}}, "materials": {"red": {"diffuse": [1, 0, 0, 1],
    "shininess": 5}, "green": {"preset": "emerald", "shininess": 3}},
    "frame": [{"draw": "m", "material": "red", "back_material": "green",
    "transform": [{"translate": [1, 2, 3]}, {"scale": [2, 2, 2]}],
               "shading": "flat", "lighting": false, "color_material": "ambient_and_diffuse",
    "provoking_vertex": "first", "normalize": false,
               "cull": "back", "front_face": "cw", "depth": {"test": "gequal", "write": false},
    "depth_range": [1, 0.5],
               "color_mask": [true, false, true, false], "plane_mask": 4294967295, "viewport": [-1, 2, 3, 4],
    "scissor": [5, 6, 7, 8]}])");
  const DrawState& s = draw_of(scene, 0).state;
  EXPECT_EQ(s.material.shininess, 5);
  EXPECT_TRUE(same(s.material.diffuse, {1, 0, 0, 1}));
  EXPECT_TRUE(same(s.material.ambient, Material{}.ambient));
  ASSERT_TRUE(s.back_material);
  EXPECT_EQ(s.back_material->shininess, 3);
  EXPECT_TRUE(same(s.back_material->diffuse, named_material("emerald")->diffuse));
  EXPECT_TRUE(same(s.transform, translate(1, 2, 3) * scale(2, 2, 2)));
  EXPECT_EQ(s.shading, Shading::flat);
  EXPECT_FALSE(s.lighting);
  EXPECT_EQ(s.color_material, ColorMaterial::ambient_and_diffuse);
  EXPECT_EQ(s.provoking_vertex, ProvokingVertex::first);
  EXPECT_FALSE(s.normalize);
  EXPECT_EQ(s.cull, Cull::back);
  EXPECT_EQ(s.front_face, FrontFace::cw);
  EXPECT_EQ(s.depth.test, Compare::gequal);
  EXPECT_FALSE(s.depth.write);
  EXPECT_EQ(s.depth_near, 1);
  EXPECT_EQ(s.depth_far, 0.5);
  EXPECT_EQ(s.color_mask, (std::array<bool, 4>{true, false, true, false}));
  EXPECT_EQ(s.plane_mask, 0xffffffffu);
  EXPECT_EQ(s.viewport->x, -1);
  EXPECT_EQ(s.scissor->height, 8);
}

TEST(SceneDefaults, ReadsInlineMeshes) {
  const Scene scene = parse(R"("meshes": {
    "a": {"positions": [[0,0,0],[1,0,0],[0,1,0]], "normals": [[0,0,1],[0,0,1],[0,0,1]],
    "colors": [[1,0,0,1],[0,1,0,1],[0,0,1,1]], "indices": [2,1,0]},
    "b": {"primitive": "triangles", "positions": [[0,0,0,1],[1,0,0,2],[0,1,0,3]]}})");
  EXPECT_EQ(scene.meshes[0].position_components, 3);
  EXPECT_EQ(scene.meshes[0].indices, (std::vector<std::uint32_t>{2, 1, 0}));
  EXPECT_EQ(scene.meshes[0].colors.size(), 12u);
  EXPECT_EQ(scene.meshes[1].position_components, 4);
  EXPECT_EQ(scene.meshes[1].positions[7], 2);
  EXPECT_EQ(scene.meshes[1].triangle_count(), 1u);
}

TEST(SceneDefaults, AnimatesNumbersInLongLists) {
  const Scene scene = parse(R"("meshes": {"m": {"positions": [[0,0,0],[1,0,0],[0,1,0]],
    "indices": [0,1,2, 0,1,2, 0,1,2, 0,1,2, 0,1,2, 0,1,{"keys": [[0, 2], [1, 0]]}]}})");
  ASSERT_EQ(scene.meshes[0].indices.size(), 18u);
  EXPECT_EQ(scene.meshes[0].indices.back(), 2u);
}

TEST(SceneDefaults, ReadsCameraAndLightsCommands) {
  const Scene scene = parse(
      R"("frame": [{"camera": {"view": [1,0,0,0, 0,1,0,0, 0,0,1,-5, 0,0,0,1],
    "projection": [1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1], "reversed": true}},
                                         {"lights": []}, {"lights": [{}, {}]}])");
  const auto& camera = std::get<SceneCamera>(scene.frame[0].value);
  EXPECT_TRUE(camera.reversed);
  EXPECT_EQ(camera.at_aspect(3).view.m[11], -5);
  EXPECT_TRUE(same(camera.at_aspect(3).projection, Matrix{}));
  EXPECT_TRUE(std::get<LightList>(scene.frame[1].value).empty());
  EXPECT_EQ(std::get<LightList>(scene.frame[2].value).size(), 2u);
}

TEST(SceneDefaults, BuiltInSceneIsShinyTeapot) {
  const Scene scene = builtin_scene();
  EXPECT_EQ(scene.title, "shiny teapot");
  ASSERT_EQ(scene.meshes.size(), 1u);
  EXPECT_GT(scene.meshes[0].triangle_count(), 8000u);
  EXPECT_EQ(draw_of(scene, 1).state.shading, Shading::phong);
}

TEST(SceneOverrides, SizeReplacesFrameBufferSize) {
  Scene scene = builtin_scene();
  apply({.width = 100, .height = 300}, scene);
  EXPECT_EQ(scene.framebuffer.width, 100);
  EXPECT_EQ(scene.framebuffer.height, 300);
  EXPECT_THROW(apply({.width = 0}, scene), Error);
}

TEST(SceneOverrides, ShadingAppliesToEveryDraw) {
  Scene scene = builtin_scene();
  apply({.shading = Shading::flat}, scene);
  EXPECT_EQ(draw_of(scene, 1).state.shading, Shading::flat);
}

TEST(SceneOverrides, PaletteMakesIndexBuffer) {
  const struct {
    const char* name;
    int bits;
    std::size_t entries;
  } kCases[] = {{"bw", 1, 2}, {"gray", 8, 256}, {"ega16", 4, 16}, {"vga256", 8, 256}, {"web216", 8, 216}};
  for (const auto& [name, bits, entries] : kCases) {
    Scene scene = builtin_scene();
    apply({.palette = name}, scene);
    EXPECT_EQ(scene.framebuffer.color_mode, ColorMode::index) << name;
    EXPECT_EQ(scene.framebuffer.color_bits, bits) << name;
    EXPECT_EQ(scene.framebuffer.palette.size(), entries) << name;
  }
}

TEST(SceneOverrides, RejectsPaletteThatExceedsColorBits) {
  Scene scene = builtin_scene();
  EXPECT_THROW(apply({.color_bits = 4, .palette = "vga256"}, scene), Error);
  Scene gray = builtin_scene();
  apply({.color_bits = 3, .palette = "gray"}, gray);
  EXPECT_EQ(gray.framebuffer.palette.size(), 8u);
  Scene own = parse(
      R"("framebuffer": {"color": {"mode": "index", "bits": 2}, "palette": [[0,0,0],[1,0,0],[1,1,1]]})");
  EXPECT_THROW(apply({.color_bits = 1}, own), Error);
  Scene rgb = builtin_scene();
  apply({.color_bits = 16}, rgb);
  EXPECT_EQ(rgb.framebuffer.color_mode, ColorMode::rgb);
  EXPECT_EQ(rgb.framebuffer.color_bits, 16);
}

}  // namespace
}  // namespace tessera::scene_defaults_test
