// Explanations of a draw's plan: active effects, elided effects, and the reasons.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/engine/frame/api_support.h"

namespace tessera {
namespace {

using namespace test;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

struct Setting {
  FrameBufferFormat format{.width = 16, .height = 16};
  std::vector<Light> lights{Light{}};
  LightModel model{};
  DrawState state{};
  bool normals = true;
  bool colors = false;
};

std::string explain(const Setting& setting) {
  FrameBuffer buffer(setting.format);
  Frame frame(buffer);
  MeshData mesh = whole_window();
  if (setting.normals) mesh.normals = {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1};
  if (setting.colors) mesh.colors.assign(16, 0.5f);
  frame.set_lights(setting.lights);
  frame.set_light_model(setting.model);
  frame.draw(mesh.view(), setting.state);
  return frame.explain(0);
}
Light point_light() {
  Light light;
  light.position = {1, 2, 3, 1};
  return light;
}

TEST(Explain, BlackSpecularProductHasNoHighlight) {
  Setting s;
  EXPECT_THAT(explain(s), AllOf(HasSubstr("light 0"), HasSubstr("directional"), HasSubstr("no highlight"),
                                HasSubstr("black")));
  s.state.material.specular = {0.5f, 0, 0, 1};
  EXPECT_THAT(explain(s),
              AllOf(HasSubstr("Blinn highlight, infinite viewer"), Not(HasSubstr("no highlight"))));
  s.model.local_viewer = true;
  s.model.specular = SpecularModel::phong;
  EXPECT_THAT(explain(s), HasSubstr("Phong highlight, local viewer"));
  s.lights[0].specular = {0, 1, 1, 1};
  EXPECT_THAT(explain(s), HasSubstr("no highlight")) << "red times cyan";
}

TEST(Explain, CutoffOf180IsNoSpot) {
  Setting s;
  s.lights = {point_light()};
  EXPECT_THAT(explain(s), AllOf(HasSubstr("point"), Not(HasSubstr("spot"))));
  s.lights[0].spot_cutoff = 60;
  EXPECT_THAT(explain(s), AllOf(HasSubstr("spot"), Not(HasSubstr("point"))));
}

TEST(Explain, AttenuationOf1_0_0IsElided) {
  Setting s;
  s.lights = {point_light()};
  EXPECT_THAT(explain(s), HasSubstr("attenuation 1 0 0 left out"));
  s.lights[0].attenuation_quadratic = 0.1f;
  EXPECT_THAT(explain(s), AllOf(HasSubstr("with attenuation"), Not(HasSubstr("left out"))));
  s.lights[0].spot_cutoff = 20;
  EXPECT_THAT(explain(s), HasSubstr("spot with attenuation"));
}

TEST(Explain, LightsThatAddBlackAreElided) {
  Setting s;
  s.lights.assign(3, Light{});
  s.lights[1].diffuse = s.lights[1].specular = {0, 0, 0, 1};
  EXPECT_THAT(explain(s), AllOf(HasSubstr("light 1: left out"), Not(HasSubstr("light 0: left out")),
                                Not(HasSubstr("light 2: left out"))));
  s.lights[1].ambient = {0.1f, 0, 0, 1};
  EXPECT_THAT(explain(s), AllOf(HasSubstr("light 1: "), HasSubstr("constant ambient")));
}

TEST(Explain, DrawWithoutLightsHasOneColor) {
  Setting s;
  s.lights.clear();
  for (const Shading shading : {Shading::flat, Shading::gouraud, Shading::phong}) {
    s.state.shading = shading;
    EXPECT_THAT(explain(s), HasSubstr("one colour for the draw"));
  }
}

TEST(Explain, UnlitDrawsNameTheSourceOfTheirColor) {
  Setting s;
  s.state.lighting = false;
  EXPECT_THAT(explain(s), AllOf(HasSubstr("unlit"), HasSubstr("no vertex colours"), HasSubstr("one colour"),
                                Not(HasSubstr("light 0"))));
  s.colors = true;
  EXPECT_THAT(explain(s),
              AllOf(HasSubstr("unlit vertex colours"), Not(HasSubstr("one colour for the draw"))));
}

TEST(Explain, VertexColorsMatterOnlyIfAMaterialFollowsThem) {
  Setting s;
  s.colors = true;
  EXPECT_THAT(explain(s), Not(HasSubstr("vertex colours")));
  s.state.color_material = ColorMaterial::diffuse;
  EXPECT_THAT(explain(s), HasSubstr("vertex colours"));
  s.colors = false;
  EXPECT_THAT(explain(s), Not(HasSubstr("or vertex colours"))) << "the mesh has no vertex colours";
}

TEST(Explain, MasksDecideWhetherColorIsComputed) {
  Setting s;
  EXPECT_THAT(explain(s), Not(HasSubstr("mask")));
  s.state.plane_mask = 0xff00;
  EXPECT_THAT(explain(s), HasSubstr("some colour planes are masked"));
  s.state.plane_mask = 0xff000000;
  EXPECT_THAT(explain(s), AllOf(HasSubstr("no colour plane changes"), HasSubstr("depth alone"),
                                Not(HasSubstr("light 0"))));
  s.state.plane_mask = 0xffffffff;
  s.state.color_mask = {false, true, true, true};
  EXPECT_THAT(explain(s), HasSubstr("some colour planes are masked"));
  s.state.color_mask = {false, false, false, true};
  EXPECT_THAT(explain(s), HasSubstr("no colour plane changes"));
}

TEST(Explain, DepthWithoutEffectIsElided) {
  Setting s;
  EXPECT_THAT(explain(s),
              AllOf(HasSubstr("depth test"), Not(HasSubstr("no depth test")), Not(HasSubstr("no write"))));
  s.state.depth.write = false;
  EXPECT_THAT(explain(s), HasSubstr("no write"));
  s.state.depth.test = Compare::always;
  EXPECT_THAT(explain(s), AllOf(HasSubstr("always passes and writes nothing"), HasSubstr("left out")));
  s.state.depth = {.enabled = false};
  EXPECT_THAT(explain(s), HasSubstr("no depth test"));
  s.state.depth = {};
  s.format.depth = DepthFormat::none;
  EXPECT_THAT(explain(s), HasSubstr("no depth test"));
}

TEST(Explain, DrawsThatChangeNoPixelAreElided) {
  Setting s;
  s.state.depth.test = Compare::never;
  EXPECT_THAT(explain(s), HasSubstr("can change no pixel"));
  s.state.depth = {};
  s.state.scissor = Rect{0, 0, 0, 5};
  EXPECT_THAT(explain(s), HasSubstr("can change no pixel"));
  s.state.scissor = Rect{15, 15, 9, 9};
  EXPECT_THAT(explain(s), Not(HasSubstr("can change no pixel")));
}

TEST(Explain, TwoSidedLightingHasASecondProgramUnlessBacksAreCulled) {
  Setting s;
  EXPECT_THAT(explain(s), Not(HasSubstr("back faces")));
  s.model.two_sided = true;
  s.state.back_material = Material{.specular = {1, 1, 1, 1}};
  EXPECT_THAT(explain(s),
              AllOf(HasSubstr("back faces"), HasSubstr("no highlight"), HasSubstr("Blinn highlight")));
  s.state.cull = Cull::back;
  EXPECT_THAT(explain(s), Not(HasSubstr("back faces")));
}

TEST(Explain, NamesTheShadingFrequency) {
  Setting s;
  s.state.shading = Shading::phong;
  EXPECT_THAT(explain(s), HasSubstr("lit at each visible pixel"));
  s.state.shading = Shading::gouraud;
  EXPECT_THAT(explain(s), HasSubstr("colours interpolated"));
  s.state.shading = Shading::flat;
  EXPECT_THAT(explain(s), HasSubstr("flat, lit at the vertices"));
  s.normals = false;
  EXPECT_THAT(explain(s), HasSubstr("face's normal"));
  s.state.shading = Shading::phong;
  EXPECT_THAT(explain(s), AllOf(HasSubstr("no normals"), HasSubstr("area-weighted")));
}

TEST(Explain, SampleColorsAreDeferredOnlyWithOperations) {
  Setting s;
  s.state.shading = Shading::gouraud;
  for (const int samples : {1, 4, 8}) {
    s.format.samples = samples;
    EXPECT_THAT(explain(s), HasSubstr("colours interpolated at once"));
  }
  s.state.plane_mask = 0xff00;
  EXPECT_THAT(explain(s), HasSubstr("colours interpolated at each visible pixel, once"));
  s.format.samples = 1;
  EXPECT_THAT(explain(s), HasSubstr("colours interpolated at once"));
}

TEST(Explain, WritesOneEffectPerLine) {
  FrameBuffer buffer({.width = 4, .height = 4});
  Frame frame(buffer);
  const MeshData mesh = whole_window();
  frame.draw(mesh.view(), {});
  frame.draw(mesh.view(), unlit({}));
  EXPECT_EQ(frame.draw_count(), 2u);
  EXPECT_NE(frame.explain(0), frame.explain(1));
  EXPECT_EQ(frame.explain(0).back(), '\n');
}

}  // namespace
}  // namespace tessera
