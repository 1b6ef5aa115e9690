// Inputs of user stages, against draws without a stage that must give the same picture.
#include <gtest/gtest.h>

#include <atomic>

#include "tests/engine/frame/user_stages_support.h"
#include "tests/examples/phong.h"

namespace tessera::test::user_stages_test {
using namespace user_stages;
namespace {

const Texture& checks() {
  static const std::uint8_t kTexels[] = {255, 40, 40,  255, 40,  255, 40,  60,
                                         40,  40, 255, 120, 200, 200, 200, 255};
  static const Texture kTexture({.pixels = kTexels, .width = 2, .height = 2, .channels = 4},
                                {.wrap_s = TextureWrap::repeat, .wrap_t = TextureWrap::repeat});
  return kTexture;
}

struct StateCase {
  const char* name;
  void (*change)(DrawState&);
};
const StateCase kStates[] = {
    {"plain", [](DrawState&) {}},
    {"unlit", [](DrawState& s) { s.lighting = false; }},
    {"tracked", [](DrawState& s) { s.color_material = ColorMaterial::ambient_and_diffuse; }},
    {"textured", [](DrawState& s) { s.texture = &checks(); }},
    {"blended",
     [](DrawState& s) {
       s.blend = BlendState{};
       s.material.diffuse.a = 0.5f;
     }},
    {"alpha test",
     [](DrawState& s) {
       s.texture = &checks();
       s.alpha_test = AlphaTest{};
     }},
    {"outlined",
     [](DrawState& s) {
       s.front_mode = s.back_mode = PolygonMode::line;
       s.line_width = 3;
     }},
    {"corners",
     [](DrawState& s) {
       s.front_mode = s.back_mode = PolygonMode::point;
       s.point_size = 3;
     }},
    {"offset",
     [](DrawState& s) {
       s.polygon_offset = {1, 2};
     }},
    {"no depth test", [](DrawState& s) { s.depth.enabled = false; }},
};

// Gouraud-shaded triangles are otherwise interpolated as levels, not as colours 0 to 1.
int rounding_of(Shading shading) { return shading == Shading::gouraud ? 1 : 0; }

TEST(UserStages, StagesThatPassValuesThroughChangeNothing) {
  for (const int samples : {1, 4})
    for (const Dither dither : {Dither::none, Dither::bayer4})
      for (const Shading shading : {Shading::flat, Shading::gouraud, Shading::phong})
        for (const StateCase& c : kStates)
          for (const bool discards : {false, true}) {
            FrameBufferFormat format = kFormat;
            format.samples = samples;
            format.dither = dither;
            DrawState state = shiny(shading);
            c.change(state);
            const auto expected = picture(format, state);
            state.fragment_stage = pass_through();
            state.fragment_stage->discards = discards;
            // With several samples the depth of sample 0 would replace those of the others.
            state.fragment_stage->writes_depth = discards && samples == 1;
            state.vertex_stage = VertexStage{.run = [](const VertexBlock&, void*) {},
                                             .reads = {.object = true, .eye = true, .normal = true},
                                             .writes = {.eye = true, .normal = true}};
            const auto staged = picture(format, state);
            EXPECT_LE(largest_difference(staged->buffer, expected->buffer), rounding_of(shading))
                << c.name << ", " << samples << " samples, shading " << static_cast<int>(shading)
                << (discards ? ", before the tests" : "");
            EXPECT_EQ(fingerprint(staged->buffer).depth, fingerprint(expected->buffer).depth) << c.name;
          }
}

TEST(UserStages, ClipPositionsThatPassThroughMoveNothing) {
  for (const DepthFormat depth : {DepthFormat::unorm16, DepthFormat::unorm24, DepthFormat::float32}) {
    FrameBufferFormat format = kFormat;
    format.depth = depth;
    DrawState state = shiny(Shading::phong);
    const auto expected = picture(format, state);
    state.vertex_stage = VertexStage{
        .run = [](const VertexBlock&, void*) {}, .reads = {.clip = true}, .writes = {.clip = true}};
    const auto staged = picture(format, state);
    EXPECT_EQ(fingerprint(staged->buffer), fingerprint(expected->buffer));
    EXPECT_GT(staged->stats.clipped, 10u);
  }
}

TEST(UserStages, UnreadColorsAreNotComputed) {
  DrawState state = shiny(Shading::phong);
  state.fragment_stage = FragmentStage{.run = [](const FragmentBlock& block, void*) {
    for (std::size_t i = 0; i < block.count; ++i) {
      block.color[0][i] = 1;
      block.color[1][i] = block.color[2][i] = 0;
    }
  }};
  FrameBuffer buffer(kFormat);
  Frame frame(buffer);
  frame.draw(ball().view(), state);
  const std::string text = frame.explain(0);
  EXPECT_NE(text.find("shading: skipped, the fragment stage reads no colour"), std::string::npos) << text;
  EXPECT_NE(text.find("fragment stage custom: once per visible pixel"), std::string::npos) << text;
  EXPECT_EQ(text.find("light 0"), std::string::npos) << text;
  DrawState red;
  red.lighting = false;
  red.material.diffuse = {1, 0, 0, 1};
  const MeshData plain = [] {
    MeshData mesh = ball();
    mesh.colors.clear();
    return mesh;
  }();
  EXPECT_EQ(fingerprint(picture(kFormat, state)->buffer),
            fingerprint(picture(kFormat, red, {}, plain)->buffer));
}

// A stage that changes nothing but its colour runs once per visible pixel; repetitions may come on top.
TEST(UserStages, RunOncePerVisiblePixel) {
  std::atomic<std::size_t> runs = 0;
  DrawState state = shiny(Shading::phong);
  state.fragment_stage =
      FragmentStage{.run = [](const FragmentBlock& block,
                              void* data) { *static_cast<std::atomic<std::size_t>*>(data) += block.count; },
                    .data = &runs,
                    .reads = {.color = true}};
  const auto staged = picture(kFormat, state, {.threads = 1});
  EXPECT_GE(runs, staged->stats.shaded_pixels);
  EXPECT_LT(staged->stats.shaded_pixels, 90u * 60);
  EXPECT_LT(runs, 90u * 60 * 2);
}

TEST(UserStages, GetWindowPositionsAndDepths) {
  struct Seen {
    float x[60][90] = {}, y[60][90] = {};
    double depth[60][90] = {};
  } seen;
  DrawState state = unlit({1, 1, 1, 1});
  state.fragment_stage = FragmentStage{.run =
                                           [](const FragmentBlock& block, void* data) {
                                             Seen& s = *static_cast<Seen*>(data);
                                             for (std::size_t i = 0; i < block.count; ++i) {
                                               const int x = static_cast<int>(block.x[i]);
                                               const int y = static_cast<int>(block.y[i]);
                                               s.x[y][x] = block.x[i];
                                               s.y[y][x] = block.y[i];
                                               s.depth[y][x] = block.depth[i];
                                             }
                                           },
                                       .data = &seen,
                                       .reads = {.position = true, .depth = true}};
  FrameBuffer buffer(kFormat);
  Frame frame(buffer);
  frame.clear({.color = Color{}, .depth = 1.0});
  MeshData slope = whole_window();
  for (std::size_t i = 0; i < 4; ++i)
    slope.positions[3 * i + 2] = slope.positions[3 * i] * 0.5f;  // z = x / 2
  frame.draw(slope.view(), state);
  Renderer({.threads = 1}).finish(frame);
  std::vector<float> depth(90 * 60);
  buffer.read_depth(depth);
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < 90; ++x) {
      EXPECT_EQ(seen.x[y][x], static_cast<float>(x) + 0.5f);
      EXPECT_EQ(seen.y[y][x], static_cast<float>(y) + 0.5f);
      EXPECT_EQ(static_cast<float>(seen.depth[y][x]), depth[static_cast<std::size_t>((59 - y) * 90 + x)]);
    }
}

// A draw that neither tests nor writes depth has depths all the same.
TEST(UserStages, ReadDepthWithoutADepthTest) {
  for (const bool discards : {false, true})
    for (const int samples : {1, 4}) {
      FrameBufferFormat format = kFormat;
      format.samples = samples;
      FrameBuffer buffer(format);
      Frame frame(buffer);
      frame.clear({.color = Color{0, 0, 0, 1}, .depth = 1.0});
      DrawState state = unlit({1, 1, 1, 1});
      state.depth.enabled = false;
      state.fragment_stage = FragmentStage{.run =
                                               [](const FragmentBlock& block, void*) {
                                                 for (std::size_t i = 0; i < block.count; ++i)
                                                   block.color[0][i] = static_cast<float>(block.depth[i]);
                                               },
                                           .reads = {.depth = true, .color = true},
                                           .discards = discards};
      const MeshData mesh = whole_window(0.5f);
      frame.draw(mesh.view(), state);
      Renderer().finish(frame);
      for (const std::uint32_t color : colors_of(buffer)) ASSERT_EQ(color, 0xbfffffu) << samples << discards;
    }
}

// The example's lighting of the teapot, from several sides.
TEST(UserStages, PhongLightingAsAStageEqualsTheBuiltInOne) {
  const MeshData teapot = builtin_mesh("teapot", 10);
  Phong phong{{1, 2, 0}, {0.8f, 0.3f, 0.2f}, 0.6f, 20};
  DrawState state;
  state.shading = Shading::phong;
  state.material.ambient = {0, 0, 0, 1};
  state.material.diffuse = {0.8f, 0.3f, 0.2f, 1};
  state.material.specular = {0.6f, 0.6f, 0.6f, 1};
  state.material.shininess = 20;
  for (const double angle : {0.0, 100.0, 220.0}) {
    state.transform = translate(0, 0, -3) * rotate(25, 1, 0, 0) * rotate(angle, 0, 1, 0);
    const auto drawn = [&](const DrawState& s) {
      auto buffer = std::make_unique<FrameBuffer>(FrameBufferFormat{.width = 320, .height = 240});
      Frame frame(*buffer);
      frame.set_camera({.projection = perspective(40, 4.0 / 3, 1, 10)});
      frame.set_lights({Light{.position = {1, 2, 0, 1}}});
      frame.set_light_model(
          {.ambient = {0, 0, 0, 1}, .local_viewer = true, .specular = SpecularModel::phong});
      frame.clear({.color = Color{0.1f, 0.1f, 0.15f, 1}, .depth = 1.0});
      frame.draw(teapot.view(), s);
      Renderer().finish(frame);
      return buffer;
    };
    DrawState staged = state;
    staged.fragment_stage =
        FragmentStage{.run = Phong::run, .data = &phong, .reads = {.eye = true, .normal = true}};
    EXPECT_LE(largest_difference(*drawn(staged), *drawn(state)), 1) << angle;
  }
}

TEST(UserStages, AreNamedByExplain) {
  FrameBuffer buffer(kFormat);
  Frame frame(buffer);
  DrawState state = shiny(Shading::phong);
  state.vertex_stage = VertexStage{.run = [](const VertexBlock&, void*) {}, .name = "wave"};
  state.fragment_stage = pass_through();
  frame.draw(ball().view(), state);
  state.fragment_stage->discards = true;
  frame.draw(ball().view(), state);
  state.fragment_stage = pass_through();
  state.color_mask = {false, false, false, false};
  frame.draw(ball().view(), state);
  EXPECT_NE(frame.explain(0).find("vertex stage wave: for every vertex\n"), std::string::npos);
  EXPECT_NE(frame.explain(0).find("fragment stage pass through: once per visible pixel\n"),
            std::string::npos);
  EXPECT_NE(frame.explain(1).find("fragment stage pass through: for every fragment, before the tests"),
            std::string::npos);
  EXPECT_NE(frame.explain(2).find("fragment stage pass through: skipped, no colour plane can change\n"),
            std::string::npos)
      << frame.explain(2);
}

}  // namespace
}  // namespace tessera::test::user_stages_test
