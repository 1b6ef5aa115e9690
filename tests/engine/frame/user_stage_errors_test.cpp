// Errors of user stages: odd values, exceptions, and wrong declarations.
#include <gtest/gtest.h>

#include <atomic>
#include <limits>
#include <stdexcept>

#include "tests/engine/frame/user_stages_support.h"

namespace tessera::test::user_stage_errors_test {
using namespace user_stages;
namespace {

TEST(UserStageErrors, ColorsAreClampedAndNonFiniteOnesAreCounted) {
  const auto spoil = [](const FragmentBlock& block, void*) {
    for (std::size_t i = 0; i < block.count; ++i) {
      block.color[0][i] = 7;
      block.color[1][i] = -3;
      block.color[2][i] = block.x[i] < 10 ? std::numeric_limits<float>::quiet_NaN() : 0.5f;
      if (block.x[i] > 80) block.color[3][i] = std::numeric_limits<float>::infinity();
    }
  };
  for (const bool discards : {false, true})
    for (const int samples : {1, 4}) {
      FrameBufferFormat format = kFormat;
      format.samples = samples;
      FrameBuffer buffer(format);
      Frame frame(buffer);
      frame.clear({.color = Color{0.5f, 0.5f, 0.5f, 1}, .depth = 1.0});
      DrawState state = unlit({1, 1, 1, 1});
      state.fragment_stage =
          FragmentStage{.run = spoil, .reads = {.position = true, .color = true}, .discards = discards};
      const MeshData mesh = whole_window();
      frame.draw(mesh.view(), state);
      const FrameStats stats = Renderer().finish(frame);
      // With several samples, pixels on the diagonal have a fragment of each triangle.
      EXPECT_GE(stats.non_finite_fragments, 60u * 20);
      EXPECT_LE(stats.non_finite_fragments, samples == 1 ? 60u * 20 : 60u * 21);
      const auto colors = colors_of(buffer);
      EXPECT_EQ(colors[5], 0xff0000u);
      EXPECT_EQ(colors[50], 0xff0080u);
    }
}

TEST(UserStageErrors, NonFiniteDepthDropsTheFragment) {
  FrameBuffer buffer(kFormat);
  Frame frame(buffer);
  frame.clear({.color = Color{0, 0, 0, 1}, .depth = 1.0});
  DrawState state = unlit({1, 1, 1, 1});
  state.fragment_stage =
      FragmentStage{.run =
                        [](const FragmentBlock& block, void*) {
                          for (std::size_t i = 0; i < block.count; ++i)
                            block.depth[i] = block.x[i] < 10 ? std::numeric_limits<double>::infinity() : 0.25;
                        },
                    .reads = {.position = true},
                    .writes_depth = true};
  const MeshData mesh = whole_window();
  frame.draw(mesh.view(), state);
  EXPECT_EQ(Renderer().finish(frame).non_finite_fragments, 600u);
  std::vector<float> depth(90 * 60);
  buffer.read_depth(depth);
  EXPECT_EQ(depth[5], 1.0f);
  EXPECT_NEAR(depth[20], 0.25f, 1e-6f);
}

TEST(UserStageErrors, NonFiniteVerticesDropTheirTriangles) {
  for (const int which : {0, 1, 2, 3, 4}) {
    DrawState state = shiny(Shading::phong);
    state.vertex_stage = VertexStage{.run =
                                         [](const VertexBlock& block, void* data) {
                                           const float nan = std::numeric_limits<float>::quiet_NaN();
                                           if (block.first != 0) return;
                                           switch (*static_cast<const int*>(data)) {
                                             case 0: block.clip[2][0] = nan; break;
                                             case 1: block.eye[0][0] = nan; break;
                                             case 2: block.normal[1][0] = nan; break;
                                             case 3: block.color[3][0] = nan; break;
                                             default: block.extras[7][0] = nan;
                                           }
                                         },
                                     .data = const_cast<int*>(&which),
                                     .reads = {.eye = true, .clip = true, .normal = true, .color = true},
                                     .writes = {.eye = true, .clip = true, .normal = true, .color = true},
                                     .extras = 8};
    EXPECT_GT(picture(kFormat, state)->stats.dropped_non_finite, 0u) << which;
  }
}

// An exception of a stage comes out of finish(), and the same frame can be finished afterwards.
TEST(UserStageErrors, ExceptionsEndTheFrame) {
  struct Fuse {
    std::atomic<int> left;
    static void burn(void* data) {
      if (--static_cast<Fuse*>(data)->left == 0) throw std::runtime_error("the fuse has blown");
    }
  };
  DrawState expected_state = shiny(Shading::phong);
  const auto expected = picture(kFormat, expected_state, {.elide = false});
  for (const bool in_vertices : {true, false})
    for (const bool discards : {false, true})
      for (const int at : {1, 2, 5}) {
        Fuse fuse{at};
        DrawState state = expected_state;
        if (in_vertices)
          state.vertex_stage =
              VertexStage{.run = [](const VertexBlock&, void* data) { Fuse::burn(data); }, .data = &fuse};
        else
          state.fragment_stage =
              FragmentStage{.run = [](const FragmentBlock&, void* data) { Fuse::burn(data); },
                            .data = &fuse,
                            .reads = {.color = true},
                            .discards = discards};
        FrameBuffer buffer(kFormat);
        Frame frame(buffer);
        record_balls(frame, state);
        Renderer renderer({.threads = 2});
        try {
          renderer.finish(frame);
          ADD_FAILURE() << "no exception, block " << at;
        } catch (const std::runtime_error& error) {
          EXPECT_STREQ(error.what(), "the fuse has blown");
        }
        renderer.finish(frame);  // the fuse does not blow again
        EXPECT_EQ(fingerprint(buffer), fingerprint(expected->buffer)) << in_vertices << discards << at;
      }
}

TEST(UserStageErrors, WrongStagesAreErrors) {
  const auto error_with = [&](const auto& change, FrameBufferFormat format = kFormat) {
    FrameBuffer buffer(format);
    Frame frame(buffer);
    DrawState state;
    state.fragment_stage = pass_through();
    state.vertex_stage = VertexStage{.run = [](const VertexBlock&, void*) {}};
    change(state);
    return error_of([&] { frame.draw(ball().view(), state); }).value_or("");
  };
  EXPECT_EQ(error_with([](DrawState& s) { s.fragment_stage->run = nullptr; }),
            "Frame::draw: fragment_stage.run is null, must be a function");
  EXPECT_EQ(error_with([](DrawState& s) { s.vertex_stage->run = nullptr; }),
            "Frame::draw: vertex_stage.run is null, must be a function");
  EXPECT_EQ(error_with([](DrawState& s) { s.vertex_stage->extras = 9; }),
            "Frame::draw: vertex_stage.extras is 9, must be 0 to 8");
  EXPECT_EQ(error_with([](DrawState& s) { s.fragment_stage->reads.extras = 1; }),
            "Frame::draw: fragment_stage.reads.extras is 1, must be 0 to the 0 extras that the vertex stage "
            "writes");
  EXPECT_EQ(error_with([](DrawState& s) { s.vertex_stage->writes.object = true; }),
            "Frame::draw: vertex_stage.writes.object is true, but object positions are inputs");
  EXPECT_EQ(error_with([](DrawState& s) {
              s.shadow_on = ShadowOn{.plane = {0, 1, 0, 2}};
            }),
            "Frame::draw: shadow_on and a user stage exclude each other");
  FrameBufferFormat no_depth = kFormat;
  no_depth.depth = DepthFormat::none;
  EXPECT_EQ(error_with([](DrawState&) {}, no_depth),
            "Frame::draw: the fragment stage uses depth, but the frame buffer has no depth buffer");
  const FrameBufferFormat index{.width = 8,
                                .height = 8,
                                .color_mode = ColorMode::index,
                                .color_bits = 8,
                                .palette = named_palette("gray", 8)};
  EXPECT_EQ(error_with(
                [](DrawState& s) {
                  s.material.index_ramp = {0, 1, 2};
                },
                index),
            "Frame::draw: a fragment stage works on RGB colours, but the colours of this draw are indices");
}

}  // namespace
}  // namespace tessera::test::user_stage_errors_test
