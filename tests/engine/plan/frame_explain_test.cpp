// Frame::effects and Frame::explain: which effects of a draw run, which are skipped, and why.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "tests/engine/frame/api_support.h"

namespace tessera::frame_explain_test {

void PrintTo(const EffectNote& note, std::ostream* out) {
  *out << code(note.effect) << (note.active ? ": active, " : ": skipped, ") << code(note.reason);
  if (note.back_faces) *out << ", back faces";
  if (note.light >= 0) *out << ", light " << note.light;
}

namespace {

using namespace test;
using testing::AllOf;
using testing::Contains;
using testing::Field;
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

template <class Ask>
auto ask_frame(const Setting& setting, const Ask& ask) {
  FrameBuffer buffer(setting.format);
  Frame frame(buffer);
  MeshData mesh = whole_window();
  // Normals and colours differ, so that nothing is left out because of them.
  if (setting.normals) mesh.normals = {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0.6f, 0.8f};
  if (setting.colors) {
    mesh.colors.assign(16, 0.5f);
    mesh.colors.back() = 0.75f;
  }
  frame.set_lights(setting.lights);
  frame.set_light_model(setting.model);
  frame.draw(mesh.view(), setting.state);
  return ask(frame);
}
std::vector<EffectNote> effects(const Setting& setting) {
  return ask_frame(setting, [](const Frame& frame) { return frame.effects(0); });
}
std::string explain(const Setting& setting) {
  return ask_frame(setting, [](const Frame& frame) { return frame.explain(0); });
}

auto runs(Effect effect, EffectReason reason = EffectReason::requested) {
  return Contains(AllOf(Field("effect", &EffectNote::effect, effect),
                        Field("active", &EffectNote::active, true),
                        Field("reason", &EffectNote::reason, reason)));
}
auto skips(Effect effect, EffectReason reason) {
  return Contains(AllOf(Field("effect", &EffectNote::effect, effect),
                        Field("active", &EffectNote::active, false),
                        Field("reason", &EffectNote::reason, reason)));
}
auto mentions(Effect effect) { return Contains(Field("effect", &EffectNote::effect, effect)); }
EffectNote light_note(int light, Effect effect, bool active, EffectReason reason) {
  return {.effect = effect, .active = active, .reason = reason, .light = light};
}

Light point_light() {
  Light light;
  light.position = {1, 2, 3, 1};
  return light;
}

TEST(Explain, SkipsTheHighlightIfTheSpecularProductIsBlack) {
  const auto no_highlight =
      Contains(light_note(0, Effect::light_highlight, false, EffectReason::black_specular));
  Setting s;
  EXPECT_THAT(effects(s),
              AllOf(Contains(light_note(0, Effect::light, true, EffectReason::directional)), no_highlight));
  s.state.material.specular = {0.5f, 0, 0, 1};
  EXPECT_THAT(effects(s),
              Contains(light_note(0, Effect::light_highlight, true, EffectReason::blinn_infinite_viewer)));
  s.model.local_viewer = true;
  s.model.specular = SpecularModel::phong;
  EXPECT_THAT(effects(s),
              Contains(light_note(0, Effect::light_highlight, true, EffectReason::phong_local_viewer)));
  s.lights[0].specular = {0, 1, 1, 1};
  EXPECT_THAT(effects(s), no_highlight) << "red times cyan";
}

TEST(Explain, SkipsTheSpotAtACutoffOf180) {
  Setting s;
  s.lights = {point_light()};
  EXPECT_THAT(effects(s),
              AllOf(Contains(light_note(0, Effect::light, true, EffectReason::positional)),
                    Contains(light_note(0, Effect::light_spot, false, EffectReason::cutoff_180))));
  s.lights[0].spot_cutoff = 60;
  EXPECT_THAT(effects(s), Contains(light_note(0, Effect::light_spot, true, EffectReason::requested)));
}

TEST(Explain, SkipsAttenuationOf1_0_0) {
  Setting s;
  s.lights = {point_light()};
  EXPECT_THAT(effects(s),
              Contains(light_note(0, Effect::light_attenuation, false, EffectReason::unit_attenuation)));
  s.lights[0].attenuation_quadratic = 0.1f;
  EXPECT_THAT(effects(s), Contains(light_note(0, Effect::light_attenuation, true, EffectReason::requested)));
  s.lights[0].spot_cutoff = 20;
  EXPECT_THAT(effects(s), AllOf(runs(Effect::light_attenuation), runs(Effect::light_spot)));
}

TEST(Explain, SkipsLightsThatAddBlack) {
  Setting s;
  s.lights.assign(3, Light{});
  s.lights[1].diffuse = s.lights[1].specular = {0, 0, 0, 1};
  EXPECT_THAT(effects(s), AllOf(Contains(light_note(0, Effect::light, true, EffectReason::directional)),
                                Contains(light_note(1, Effect::light, false, EffectReason::black)),
                                Contains(light_note(2, Effect::light, true, EffectReason::directional))));
  s.lights[1].ambient = {0.1f, 0, 0, 1};
  EXPECT_THAT(effects(s), Contains(light_note(1, Effect::light, false, EffectReason::constant_ambient)));
}

TEST(Explain, WithoutLightsTheDrawHasOneColor) {
  Setting s;
  s.lights.clear();
  for (const Shading shading : {Shading::flat, Shading::gouraud, Shading::phong}) {
    s.state.shading = shading;
    EXPECT_THAT(effects(s), AllOf(skips(Effect::lighting, EffectReason::independent_of_surface),
                                  runs(Effect::shading, EffectReason::per_draw)));
  }
}

TEST(Explain, NamesTheColorSourceOfUnlitDraws) {
  Setting s;
  s.state.lighting = false;
  EXPECT_THAT(effects(s), AllOf(skips(Effect::lighting, EffectReason::disabled),
                                skips(Effect::vertex_colors, EffectReason::not_in_mesh),
                                runs(Effect::shading, EffectReason::per_draw), Not(mentions(Effect::light))));
  s.colors = true;
  EXPECT_THAT(effects(s),
              AllOf(runs(Effect::vertex_colors), runs(Effect::shading, EffectReason::interpolated)));
}

TEST(Explain, LitDrawsUseVertexColorsOnlyThroughColorMaterial) {
  Setting s;
  s.colors = true;
  EXPECT_THAT(effects(s), skips(Effect::vertex_colors, EffectReason::color_material_none));
  s.state.color_material = ColorMaterial::diffuse;
  EXPECT_THAT(effects(s), runs(Effect::light_tracked_colors));
  s.colors = false;
  EXPECT_THAT(effects(s), Not(mentions(Effect::light_tracked_colors))) << "the mesh has none";
}

TEST(Explain, NamesMasksAndWhetherColorIsStored) {
  Setting s;
  EXPECT_THAT(effects(s), Not(mentions(Effect::plane_masks)));
  s.state.plane_mask = 0xff00;
  EXPECT_THAT(effects(s), runs(Effect::plane_masks));
  s.state.plane_mask = 0xff000000;
  EXPECT_THAT(effects(s),
              AllOf(skips(Effect::shading, EffectReason::no_color_stored), Not(mentions(Effect::light))));
  s.state.plane_mask = 0xffffffff;
  s.state.color_mask = {false, true, true, true};
  EXPECT_THAT(effects(s), runs(Effect::plane_masks));
  s.state.color_mask = {false, false, false, true};
  EXPECT_THAT(effects(s), skips(Effect::shading, EffectReason::no_color_stored));
}

TEST(Explain, SkipsDepthTestsWithoutEffect) {
  Setting s;
  EXPECT_THAT(effects(s), AllOf(runs(Effect::depth_test), runs(Effect::depth_write)));
  s.state.depth.write = false;
  EXPECT_THAT(effects(s),
              AllOf(runs(Effect::depth_test), skips(Effect::depth_write, EffectReason::disabled)));
  s.state.depth.test = Compare::always;
  EXPECT_THAT(effects(s), skips(Effect::depth_test, EffectReason::passes_and_writes_nothing));
  s.state.depth = {.enabled = false};
  EXPECT_THAT(effects(s), skips(Effect::depth_test, EffectReason::disabled));
  s.state.depth = {};
  s.format.depth = DepthFormat::none;
  EXPECT_THAT(effects(s), skips(Effect::depth_test, EffectReason::no_depth_buffer));
}

TEST(Explain, SkipsDrawsThatChangeNoPixel) {
  const auto skipped = skips(Effect::draw, EffectReason::no_pixel_can_change);
  Setting s;
  s.state.depth.test = Compare::never;
  EXPECT_THAT(effects(s), skipped);
  s.state.depth = {};
  s.state.scissor = Rect{0, 0, 0, 5};
  EXPECT_THAT(effects(s), skipped);
  s.state.scissor = Rect{15, 15, 9, 9};
  EXPECT_THAT(effects(s), Not(mentions(Effect::draw)));
}

TEST(Explain, TwoSidedLightingHasASecondProgramUnlessBacksAreCulled) {
  Setting s;
  EXPECT_THAT(effects(s), Not(mentions(Effect::two_sided_lighting)));
  s.model.two_sided = true;
  s.lights[0].position = {0, 1, -0.5f, 0};  // in front of some front faces and some back faces
  s.state.back_material = Material{.specular = {1, 1, 1, 1}};
  EXPECT_THAT(effects(s),
              AllOf(runs(Effect::two_sided_lighting),
                    Contains(light_note(0, Effect::light_highlight, false, EffectReason::black_specular)),
                    Contains(EffectNote{.effect = Effect::light_highlight,
                                        .reason = EffectReason::blinn_infinite_viewer,
                                        .back_faces = true,
                                        .light = 0})));
  EXPECT_THAT(explain(s), HasSubstr("  back faces, light 0 highlight: Blinn, infinite viewer\n"));
  s.state.cull = Cull::back;
  EXPECT_THAT(effects(s), Not(mentions(Effect::two_sided_lighting)));
}

TEST(Explain, NamesTheShadingRate) {
  Setting s;
  s.state.shading = Shading::phong;
  EXPECT_THAT(effects(s), runs(Effect::shading, EffectReason::per_pixel));
  s.state.shading = Shading::gouraud;
  EXPECT_THAT(effects(s), runs(Effect::shading, EffectReason::interpolated));
  s.state.shading = Shading::flat;
  EXPECT_THAT(effects(s), runs(Effect::shading, EffectReason::per_vertex));
  s.normals = false;
  EXPECT_THAT(effects(s), AllOf(runs(Effect::shading, EffectReason::per_face),
                                runs(Effect::generated_normals, EffectReason::face_normals)));
  s.state.shading = Shading::phong;
  EXPECT_THAT(effects(s), runs(Effect::generated_normals, EffectReason::mean_normals));
}

TEST(Explain, DefersColorsOfSamplesOnlyIfMoreThanStoringFollows) {
  Setting s;
  s.state.shading = Shading::gouraud;
  for (const int samples : {1, 4, 8}) {
    s.format.samples = samples;
    EXPECT_THAT(effects(s), runs(Effect::shading, EffectReason::interpolated));
  }
  EXPECT_THAT(effects(s), Contains(EffectNote{.effect = Effect::multisampling, .samples = 8}));
  s.state.plane_mask = 0xff00;
  EXPECT_THAT(effects(s), runs(Effect::shading, EffectReason::interpolated_per_pixel));
  s.format.samples = 1;
  EXPECT_THAT(effects(s), runs(Effect::shading, EffectReason::interpolated));
}

TEST(Explain, TextHasOneLinePerEffect) {
  Setting s;
  s.lights = {point_light()};
  s.lights[0].ambient = {1, 1, 1, 1};
  s.format.samples = 4;
  EXPECT_EQ(
      explain(s),
      "  depth test: on\n"
      "  depth write: on\n"
      "  multisampling: 4 samples per pixel; coverage, depth and stencil per sample, colour per pixel\n"
      "  light 0: positional\n"
      "  light 0 attenuation: skipped, the factors are 1 0 0\n"
      "  light 0 spot: off, the cutoff is 180 degrees\n"
      "  light 0 highlight: skipped, the specular product is black\n"
      "  light 0 ambient part: differs between points\n"
      "  shading: colours interpolated as triangles are drawn\n"
      "  code path: triangles with several samples, colour interpolated, depth unorm24, less and write\n");
}

TEST(Explain, BuffersThatNothingReadsAreNotAllocated) {
  FrameBuffer buffer({.width = 16, .height = 16, .accumulation_bits = 16});
  Frame frame(buffer);
  const auto reasons = [&](bool presented) {
    std::vector<BufferReason> list;
    for (const BufferNote& note : frame.buffers(presented)) list.push_back(note.reason);
    return list;
  };
  frame.clear({.color = Color{0, 0, 0, 1}, .depth = 1.0, .stencil = 3});
  EXPECT_EQ(reasons(false), (std::vector{BufferReason::ends_cleared, BufferReason::ends_cleared,
                                         BufferReason::ends_cleared, BufferReason::not_used}));
  const MeshData mesh = whole_window();
  frame.draw(mesh.view(), unlit({1, 1, 1, 1}));
  EXPECT_EQ(reasons(true), (std::vector{BufferReason::not_kept, BufferReason::not_kept,
                                        BufferReason::not_used, BufferReason::not_used}));
  frame.keep({Buffer::depth});
  EXPECT_EQ(reasons(true)[1], BufferReason::kept);
  EXPECT_TRUE(frame.buffers()[1].stored);
  EXPECT_FALSE(frame.buffers()[1].loaded);
  EXPECT_EQ(text(frame.buffers()[2]), "stencil: not allocated, nothing reads it");
  EXPECT_EQ(code(BufferReason::not_used), "not_used");
  Renderer().finish(frame);
  EXPECT_EQ(buffer.allocated_bytes(Buffer::color), 0u);
  EXPECT_GT(buffer.allocated_bytes(Buffer::depth), 0u);
  EXPECT_EQ(buffer.allocated_bytes(Buffer::stencil), 0u);

  FrameBuffer plain({.width = 16, .height = 16, .depth = DepthFormat::none, .stencil_bits = 0});
  EXPECT_EQ(Frame(plain).buffers()[1].reason, BufferReason::not_in_format);
}

TEST(Explain, NamesTheCodePathOfEachPolygonMode) {
  Setting s;
  s.state.lighting = false;
  EXPECT_THAT(explain(s),
              HasSubstr("  code path: triangles, colour constant, depth unorm24, less and write\n"));
  s.colors = true;
  s.state.alpha_test = AlphaTest{};
  EXPECT_THAT(explain(s), HasSubstr("code path: fragments of triangles, colour evaluated, depth unorm24\n"));
  s.state = {.lighting = false, .back_mode = PolygonMode::line};
  EXPECT_THAT(explain(s), AllOf(HasSubstr("  code path: fragments of triangles, colour evaluated"),
                                HasSubstr("  code path: fragments of lines, colour")));
  s.state.depth.test = Compare::never;
  EXPECT_THAT(explain(s), Not(HasSubstr("code path")));
}

TEST(Explain, CountsEveryDraw) {
  FrameBuffer buffer({.width = 4, .height = 4});
  Frame frame(buffer);
  const MeshData mesh = whole_window();
  frame.draw(mesh.view(), {});
  frame.draw(mesh.view(), unlit({}));
  EXPECT_EQ(frame.draw_count(), 2u);
  EXPECT_NE(frame.effects(0), frame.effects(1));
  EXPECT_NE(frame.explain(0), frame.explain(1));
  EXPECT_THROW((void)frame.effects(2), Error);
}

TEST(Explain, CodesAreDistinctKebabCase) {
  std::set<std::string_view> codes;
  const auto check = [&](std::string_view text) {
    EXPECT_FALSE(text.empty());
    EXPECT_EQ(text.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_"), std::string_view::npos)
        << text;
    EXPECT_TRUE(codes.insert(text).second) << text;
  };
  for (int i = 0; i <= static_cast<int>(Effect::fragment_stage); ++i) check(code(static_cast<Effect>(i)));
  codes.clear();
  for (int i = 0; i <= static_cast<int>(EffectReason::replaced_by_stage); ++i)
    check(code(static_cast<EffectReason>(i)));
  EXPECT_EQ(code(Effect::depth_test), "depth_test");
  EXPECT_EQ(code(EffectReason::no_depth_buffer), "no_depth_buffer");
  EXPECT_EQ(code(static_cast<Effect>(255)), "");
  EXPECT_EQ(code(static_cast<EffectReason>(255)), "");
}

}  // namespace
}  // namespace tessera::frame_explain_test
