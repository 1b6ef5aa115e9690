// Errors of recording: each message names the value found and the value expected, and the frame is unchanged.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "tests/engine/frame/api_support.h"

namespace tessera::api_error_frames_test {
namespace {

using namespace test;
using testing::HasSubstr;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

struct Misuse {
  const char* what;
  std::function<void(Frame&)> act;
  std::vector<std::string> substrings;  ///< all substrings of the message
};

const FrameBufferFormat kRgb{.width = 24, .height = 16, .stencil_bits = 3};
const FrameBufferFormat kIndex{.width = 24, .height = 16, .color_mode = ColorMode::index, .color_bits = 4};
const FrameBufferFormat kAccumulating{.width = 24, .height = 16, .accumulation_bits = 16};
const FrameBufferFormat kGray1{.width = 24, .height = 16, .color_bits = 1};
const FrameBufferFormat kGray2{.width = 24, .height = 16, .color_bits = 2};
const FrameBufferFormat kBare{.width = 24, .height = 16, .depth = DepthFormat::none, .stencil_bits = 0};

// A valid frame: half of it recorded before the misuse, half after it.
const MeshData kLeft = rectangle(-0.9f, -0.9f, 0.1f, 0.8f, 0.2f);
const MeshData kRight = rectangle(-0.3f, -0.5f, 0.9f, 0.9f, -0.2f);
void record_first_half(Frame& frame) {
  frame.clear({.color = Color{0.2f, 0.3f, 0.4f, 1}});
  frame.draw(kLeft.view(), {});
}
void record_second_half(Frame& frame) { frame.draw(kRight.view(), unlit({1, 0.5f, 0, 1})); }

void expect_errors(const FrameBufferFormat& format, const std::vector<Misuse>& misuses) {
  Renderer renderer({.threads = 1});
  FrameBuffer undisturbed(format);
  Frame reference(undisturbed);
  record_first_half(reference);
  record_second_half(reference);
  renderer.finish(reference);
  for (const Misuse& misuse : misuses) {
    SCOPED_TRACE(misuse.what);
    FrameBuffer buffer(format);
    Frame frame(buffer);
    record_first_half(frame);
    const std::optional<std::string> error = error_of([&] { misuse.act(frame); });
    EXPECT_TRUE(error) << "no error was thrown";
    for (const std::string& words : misuse.substrings) EXPECT_THAT(error.value_or(""), HasSubstr(words));
    EXPECT_EQ(frame.draw_count(), 1u);
    record_second_half(frame);
    renderer.finish(frame);
    EXPECT_EQ(fingerprint(buffer), fingerprint(undisturbed)) << "the frame has changed";
  }
}

Misuse light(const char* what, const std::function<void(Light&)>& change,
             std::vector<std::string> substrings) {
  substrings.push_back("light 1");
  return {what,
          [change](Frame& frame) {
            std::vector<Light> lights(3);
            change(lights[1]);
            frame.set_lights(lights);
          },
          std::move(substrings)};
}

TEST(ErrorsOfFrames, NameInvalidLightsAndCameras) {
  expect_errors(
      kRgb,
      {
          light("ambient", [](Light& l) { l.ambient.g = kNan; }, {"ambient", "nan", "finite"}),
          light("diffuse", [](Light& l) { l.diffuse.b = kInfinity; }, {"diffuse", "inf", "finite"}),
          light("specular", [](Light& l) { l.specular.a = kNan; }, {"specular", "nan", "finite"}),
          light("position", [](Light& l) { l.position[3] = kNan; }, {"position", "nan", "finite"}),
          light("direction", [](Light& l) { l.spot_direction[0] = -kInfinity; },
                {"spot_direction", "inf", "finite"}),
          light("exponent -1", [](Light& l) { l.spot_exponent = -1; }, {"spot_exponent is -1", "0", "16384"}),
          light("exponent 16385", [](Light& l) { l.spot_exponent = 16385; },
                {"spot_exponent is 16385", "16384"}),
          light("exponent nan", [](Light& l) { l.spot_exponent = kNan; }, {"spot_exponent is nan"}),
          light("cutoff 91", [](Light& l) { l.spot_cutoff = 91; }, {"spot_cutoff is 91", "0 to 90, or 180"}),
          light("cutoff -1", [](Light& l) { l.spot_cutoff = -1; }, {"spot_cutoff is -1", "0 to 90, or 180"}),
          light("cutoff 179", [](Light& l) { l.spot_cutoff = 179; },
                {"spot_cutoff is 179", "0 to 90, or 180"}),
          light("cutoff nan", [](Light& l) { l.spot_cutoff = kNan; }, {"spot_cutoff is nan"}),
          light("attenuation", [](Light& l) { l.attenuation_quadratic = kInfinity; },
                {"attenuation", "inf", "finite"}),
          {"view",
           [](Frame& f) {
             Camera c;
             c.view.m[7] = kNan;
             f.set_camera(c);
           },
           {"view", "nan", "finite"}},
          {"projection",
           [](Frame& f) {
             Camera c;
             c.projection.m[0] = kInfinity;
             f.set_camera(c);
           },
           {"projection", "inf", "finite"}},
          {"scene ambient",
           [](Frame& f) {
             f.set_light_model({.ambient = {kNan, 0, 0, 1}});
           },
           {"ambient", "nan", "finite"}},
          {"shading cap",
           [](Frame& f) { f.set_quality({.shading = static_cast<ShadingCap>(5)}); },
           {"set_quality: shading", "5", "0 to 4"}},
          {"viewer cap",
           [](Frame& f) { f.set_quality({.viewer = static_cast<ViewerCap>(2)}); },
           {"set_quality: viewer", "2", "0 to 1"}},
          {"interpolation cap",
           [](Frame& f) { f.set_quality({.interpolation = static_cast<InterpolationCap>(2)}); },
           {"set_quality: interpolation", "2", "0 to 1"}},
          {"texture cap",
           [](Frame& f) { f.set_quality({.texture = static_cast<TextureCap>(3)}); },
           {"set_quality: texture", "3", "0 to 2"}},
          {"light threshold",
           [](Frame& f) { f.set_quality({.light_threshold = 1.5f}); },
           {"set_quality: light_threshold", "1.5", "0 to 1"}},
          {"light threshold that is no number",
           [](Frame& f) { f.set_quality({.light_threshold = kNan}); },
           {"set_quality: light_threshold", "nan", "0 to 1"}},
      });
}

Misuse clear(const char* what, const Clear& clear, std::vector<std::string> substrings) {
  return {what, [clear](Frame& frame) { frame.clear(clear); }, std::move(substrings)};
}

TEST(ErrorsOfFrames, NameClearsOutOfRangeOrOfMissingBuffers) {
  expect_errors(
      kRgb,
      {
          clear("colour above 1", {.color = Color{0, 1.5f, 0, 1}}, {"color", "1.5", "0", "1"}),
          clear("colour below 0", {.color = Color{0, 0, -0.25f, 1}}, {"color", "-0.25"}),
          clear("alpha above 1", {.color = Color{0, 0, 0, 3}}, {"color", "3"}),
          clear("colour nan", {.color = Color{kNan, 0, 0, 1}}, {"color", "nan"}),
          clear("index in RGB", {.index = 3u}, {"index", "rgb"}),
          clear("depth above 1", {.depth = 1.25}, {"depth is 1.25", "0", "1"}),
          clear("depth below 0", {.depth = -0.5}, {"depth is -0.5"}),
          clear("depth nan", {.depth = double{kNan}}, {"depth is nan"}),
          clear("stencil 8 of 3 bits", {.stencil = 8u}, {"stencil value is 8", "7"}),
          clear("scissor", {.color = Color{}, .scissor = Rect{0, 0, -3, 5}}, {"scissor", "-3", "negative"}),
          clear("a good colour and a bad depth", {.color = Color{1, 1, 1, 1}, .depth = 2.0}, {"depth is 2"}),
      });
  expect_errors(kBare, {
                           clear("no depth", {.depth = 1.0}, {"depth", "no depth buffer"}),
                           clear("no stencil", {.stencil = 0u}, {"stencil", "no stencil buffer"}),
                       });
  expect_errors(kBare, {clear("no accumulation", {.accumulation = Color{}},
                              {"accumulation", "no accumulation buffer"})});
  expect_errors(
      kAccumulating,
      {
          clear("accumulation above 1", {.accumulation = Color{0, 1.5f, 0, 0}},
                {"accumulation", "1.5", "-1 to 1"}),
          clear("accumulation below -1", {.accumulation = Color{0, 0, 0, -1.25f}},
                {"accumulation", "-1.25", "-1 to 1"}),
          clear("accumulation nan", {.accumulation = Color{kNan, 0, 0, 0}}, {"accumulation", "nan"}),
          clear("a good depth and a bad accumulation", {.depth = 0.0, .accumulation = Color{2, 0, 0, 0}},
                {"accumulation", "2"}),
      });
  expect_errors(kIndex,
                {
                    clear("index 16 of 4 bits", {.index = 16u}, {"index is 16", "15"}),
                    clear("accumulation of indices", {.accumulation = Color{}}, {"no accumulation buffer"}),
                });
}

Misuse accumulate(const char* what, const Accum& accum, std::vector<std::string> substrings) {
  return {what, [accum](Frame& frame) { frame.accumulate(accum); }, std::move(substrings)};
}

TEST(ErrorsOfFrames, NameInvalidAccumulations) {
  expect_errors(kAccumulating,
                {
                    accumulate("value nan", {.value = double{kNan}}, {"value", "nan", "finite"}),
                    accumulate("value infinite", {.op = AccumOp::mult, .value = -double{kInfinity}},
                               {"value", "-inf", "finite"}),
                    accumulate("scissor", {.op = AccumOp::load, .scissor = Rect{0, 0, 4, -2}},
                               {"scissor", "-2", "negative"}),
                });
  expect_errors(kRgb, {accumulate("no buffer", {}, {"Frame::accumulate", "no accumulation buffer"})});
  expect_errors(kIndex, {accumulate("indices", {}, {"Frame::accumulate", "indices"})});
  FrameBufferFormat gray = kGray2;
  gray.accumulation_bits = 16;
  expect_errors(gray, {accumulate("a split mask",
                                  {.op = AccumOp::return_color, .color_mask = {true, true, false, true}},
                                  {"Frame::accumulate", "luminance", "all or none"})});
}

const std::vector<float> kTwoTriangles(18, 0.5f);
const std::vector<std::uint32_t> kIndices{0, 1, 2, 3, 4, 5};

Misuse mesh(const char* what, const std::function<void(Mesh&)>& change, std::vector<std::string> substrings) {
  return {what,
          [change](Frame& frame) {
            Mesh m{.positions = kTwoTriangles};
            change(m);
            frame.draw(m, {});
          },
          std::move(substrings)};
}

TEST(ErrorsOfFrames, NameMismatchedSpans) {
  static const std::vector<float> floats(64, 0.0f);
  const auto first = [](std::size_t n) { return std::span<const float>(floats).first(n); };
  expect_errors(
      kRgb,
      {
          mesh("2 components", [](Mesh& m) { m.position_components = 2; },
               {"position_components is 2", "3 or 4"}),
          mesh("0 components", [](Mesh& m) { m.position_components = 0; },
               {"position_components is 0", "3 or 4"}),
          mesh("-3 components", [](Mesh& m) { m.position_components = -3; },
               {"position_components is -3", "3 or 4"}),
          mesh("10 floats", [=](Mesh& m) { m.positions = first(10); }, {"10 floats", "multiple of 3"}),
          mesh("18 floats of 4", [](Mesh& m) { m.position_components = 4; }, {"18 floats", "multiple of 4"}),
          mesh("4 vertices", [=](Mesh& m) { m.positions = first(12); }, {"4 vertices", "multiple of 3"}),
          mesh("4 indices", [](Mesh& m) { m.indices = std::span(kIndices).first(4); },
               {"4 indices", "multiple of 3"}),
          mesh("17 floats of normals", [=](Mesh& m) { m.normals = first(17); },
               {"17 floats of normals", "6 vertices", "18"}),
          mesh("one normal", [=](Mesh& m) { m.normals = first(3); }, {"3 floats of normals", "18"}),
          mesh("RGB colours", [=](Mesh& m) { m.colors = first(18); }, {"18 floats of colors", "24"}),
          mesh("indices without positions",
               [](Mesh& m) {
                 m.positions = {};
                 m.indices = kIndices;
               },
               {"6 indices", "no vertices"}),
          mesh("normals without positions",
               [=](Mesh& m) {
                 m.positions = {};
                 m.normals = first(3);
               },
               {"3 floats of normals", "0"}),
      });
}

Misuse state(const char* what, const std::function<void(DrawState&)>& change,
             std::vector<std::string> substrings) {
  return {what,
          [change](Frame& frame) {
            DrawState s;
            change(s);
            frame.draw(kLeft.view(), s);
          },
          std::move(substrings)};
}

TEST(ErrorsOfFrames, NameDrawStatesOutOfRange) {
  expect_errors(
      kRgb,
      {
          state("shininess 16385", [](DrawState& s) { s.material.shininess = 16385; },
                {"shininess is 16385", "16384"}),
          state("shininess -1", [](DrawState& s) { s.material.shininess = -1; }, {"shininess is -1", "0"}),
          state("shininess nan", [](DrawState& s) { s.material.shininess = kNan; }, {"shininess is nan"}),
          state("ambient", [](DrawState& s) { s.material.ambient.r = kNan; },
                {"material.ambient", "nan", "finite"}),
          state("diffuse", [](DrawState& s) { s.material.diffuse.g = kInfinity; },
                {"material.diffuse", "inf", "finite"}),
          state("specular", [](DrawState& s) { s.material.specular.b = kNan; },
                {"material.specular", "nan", "finite"}),
          state("emission", [](DrawState& s) { s.material.emission.a = kNan; },
                {"material.emission", "nan", "finite"}),
          state("back", [](DrawState& s) { s.back_material = Material{.shininess = 99999}; },
                {"back_material", "99999", "16384"}),
          state("transform", [](DrawState& s) { s.transform.m[3] = kNan; }, {"transform", "nan", "finite"}),
          state("depth near", [](DrawState& s) { s.depth_near = -0.5; }, {"depth_near is -0.5", "0", "1"}),
          state("depth far", [](DrawState& s) { s.depth_far = 1.5; }, {"depth_far is 1.5", "0", "1"}),
          state("depth far nan", [](DrawState& s) { s.depth_far = kNan; }, {"depth_far is nan"}),
          state("viewport empty",
                [](DrawState& s) {
                  s.viewport = Rect{0, 0, 0, 5};
                },
                {"viewport", "0", "16384"}),
          state("viewport negative",
                [](DrawState& s) {
                  s.viewport = Rect{0, 0, 5, -5};
                },
                {"viewport", "-5"}),
          state("viewport wide",
                [](DrawState& s) {
                  s.viewport = Rect{0, 0, 16385, 5};
                },
                {"viewport", "16385", "16384"}),
          state("viewport far off",
                [](DrawState& s) {
                  s.viewport = Rect{0, 100000, 5, 5};
                },
                {"viewport", "100000"}),
          state("scissor negative",
                [](DrawState& s) {
                  s.scissor = Rect{0, 0, -1, 5};
                },
                {"scissor", "-1", "negative"}),
      });
}

TEST(ErrorsOfFrames, NameOperationsOutOfRange) {
  expect_errors(
      kRgb, {
                state("offset factor", [](DrawState& s) { s.polygon_offset.factor = kNan; },
                      {"polygon_offset", "nan", "finite"}),
                state("offset units", [](DrawState& s) { s.polygon_offset.units = kInfinity; },
                      {"polygon_offset", "inf", "finite"}),
                state("alpha reference above 1", [](DrawState& s) { s.alpha_test = AlphaTest{.ref = 1.5f}; },
                      {"alpha_test.ref is 1.5", "0 to 1"}),
                state("alpha reference below 0", [](DrawState& s) { s.alpha_test = AlphaTest{.ref = -0.5f}; },
                      {"alpha_test.ref is -0.5", "0 to 1"}),
                state("alpha reference nan", [](DrawState& s) { s.alpha_test = AlphaTest{.ref = kNan}; },
                      {"alpha_test.ref is nan"}),
                state("blend constant above 1",
                      [](DrawState& s) {
                        s.blend = BlendState{.color = {0, 0, 0, 1.25f}};
                      },
                      {"blend.color is 1.25", "0 to 1"}),
                state("blend constant below 0",
                      [](DrawState& s) {
                        s.blend = BlendState{.color = {-1, 0, 0, 0}};
                      },
                      {"blend.color is -1", "0 to 1"}),
                state("blend constant nan",
                      [](DrawState& s) {
                        s.blend = BlendState{.color = {0, kNan, 0, 0}};
                      },
                      {"blend.color is nan"}),
                state("blend and logic", [](DrawState& s) { s.blend.emplace(), s.logic_op = LogicOp::noop; },
                      {"blending", "logic operation", "one of them"}),
            });
}

TEST(ErrorsOfFrames, NameOperationsWithoutTheirBuffer) {
  expect_errors(kBare, {
                           state("factor without depth",
                                 [](DrawState& s) {
                                   s.polygon_offset = {1, 0};
                                 },
                                 {"polygon offset", "no depth buffer"}),
                           state("units without depth",
                                 [](DrawState& s) {
                                   s.polygon_offset = {0, -1};
                                 },
                                 {"polygon offset", "no depth buffer"}),
                           state("no stencil", [](DrawState& s) { s.stencil.emplace(); },
                                 {"stencil test", "no stencil buffer"}),
                       });
  expect_errors(kIndex, {
                            state("alpha test of indices", [](DrawState& s) { s.alpha_test.emplace(); },
                                  {"alpha test", "indices", "no alpha"}),
                            state("blending of indices", [](DrawState& s) { s.blend.emplace(); },
                                  {"blending", "indices", "do not blend"}),
                        });
  // These need no buffer.
  FrameBuffer bare(kBare);
  FrameBuffer index(kIndex);
  Frame into_bare(bare);
  Frame into_index(index);
  DrawState plain;
  plain.polygon_offset = {0, 0};
  plain.blend.emplace();
  EXPECT_FALSE(error_of([&] { into_bare.draw(kLeft.view(), plain); }))
      << "an offset of 0, and a blend with the copying logic operation";
  DrawState logic;
  logic.logic_op = LogicOp::bit_xor;
  logic.stencil.emplace();
  EXPECT_FALSE(error_of([&] { into_index.draw(kLeft.view(), logic); }));
}

TEST(ErrorsOfFrames, NameColorMasksThatSplitAPackedValue) {
  const auto masked = [](std::array<bool, 4> mask) {
    return state("a split mask", [mask](DrawState& s) { s.color_mask = mask; }, {"mask", "all or none"});
  };
  for (const FrameBufferFormat& format : {kIndex, kGray1, kGray2}) {
    expect_errors(format, {masked({true, false, false, true}), masked({true, true, false, true}),
                           masked({false, false, true, false})});
    FrameBuffer buffer(format);
    Frame frame(buffer);
    for (const bool all : {true, false})
      for (const bool alpha : {true, false}) {
        DrawState s;
        s.color_mask = {all, all, all, alpha};
        EXPECT_FALSE(error_of([&] { frame.draw(kLeft.view(), s); }))
            << "the buffer has no alpha plane: its mask has no effect";
      }
  }
}

TEST(ErrorsOfFrames, NameADrawThatCannotBeExplained) {
  expect_errors(kRgb, {{"draw 1 of 1", [](Frame& frame) { (void)frame.explain(1); }, {"draw 1", "1"}}});
}

}  // namespace
}  // namespace tessera::api_error_frames_test
