// Outputs of user stages: what they write or discard, against draws without a stage.
#include <gtest/gtest.h>

#include <atomic>
#include <utility>

#include "tests/engine/frame/user_stages_support.h"

namespace tessera::test::user_stage_outputs_test {
using namespace user_stages;
namespace {

TEST(UserStageOutputs, DiscardLikeAScissor) {
  DrawState state = shiny(Shading::phong);
  state.scissor = Rect{0, 0, 40, 60};
  const auto expected = picture(kFormat, state);
  state.scissor.reset();
  state.fragment_stage = FragmentStage{.run =
                                           [](const FragmentBlock& block, void*) {
                                             for (std::size_t i = 0; i < block.count; ++i)
                                               block.keep[i] = block.x[i] < 40;
                                           },
                                       .reads = {.position = true, .color = true},
                                       .discards = true};
  EXPECT_EQ(fingerprint(picture(kFormat, state)->buffer), fingerprint(expected->buffer));
}

TEST(UserStageOutputs, WriteDepthLikeADepthRange) {
  for (const DepthFormat depth : {DepthFormat::unorm16, DepthFormat::unorm24}) {
    FrameBufferFormat format = kFormat;
    format.depth = depth;
    DrawState state = shiny(Shading::phong);
    state.depth_near = 1;
    state.depth_far = 0;
    const auto expected = picture(format, state);
    std::swap(state.depth_near, state.depth_far);
    state.fragment_stage = FragmentStage{.run =
                                             [](const FragmentBlock& block, void*) {
                                               for (std::size_t i = 0; i < block.count; ++i)
                                                 block.depth[i] = 1 - block.depth[i];
                                             },
                                         .reads = {.depth = true, .color = true},
                                         .writes_depth = true};
    // A level in the middle between two rounds the other way.
    const auto staged = picture(format, state);
    const auto a = stored_depths(staged->buffer), b = stored_depths(expected->buffer);
    for (std::size_t i = 0; i < a.size(); ++i)
      EXPECT_LE(std::abs(static_cast<std::int64_t>(a[i]) - static_cast<std::int64_t>(b[i])), 1);
  }
}

TEST(UserStageOutputs, ColorsOfVerticesComeFromTheStage) {
  const auto paint = [](const VertexBlock& block, void*) {
    for (std::size_t i = 0; i < block.count; ++i) {
      block.color[0][i] = block.object[1][i] > 0 ? 1.0f : 0.25f;
      block.color[1][i] = 0.5f;
      block.color[2][i] = block.object[0][i] * 0.5f + 0.5f;
      block.color[3][i] = 1;
    }
  };
  MeshData painted = ball(), plain = ball();
  plain.colors.clear();
  painted.colors.clear();
  for (std::size_t i = 0; i < painted.positions.size(); i += 3) {
    const float x = painted.positions[i], y = painted.positions[i + 1];
    painted.colors.insert(painted.colors.end(), {y > 0 ? 1.0f : 0.25f, 0.5f, x * 0.5f + 0.5f, 1});
  }
  for (const Shading shading : {Shading::flat, Shading::gouraud, Shading::phong})
    for (const bool lighting : {false, true}) {
      DrawState state = shiny(shading);
      state.lighting = lighting;
      state.color_material = ColorMaterial::diffuse;
      const auto expected = picture(kFormat, state, {.elide = false}, painted);
      state.vertex_stage = VertexStage{.run = paint, .reads = {.object = true}, .writes = {.color = true}};
      EXPECT_EQ(fingerprint(picture(kFormat, state, {}, plain)->buffer), fingerprint(expected->buffer))
          << static_cast<int>(shading) << lighting;
    }
}

TEST(UserStageOutputs, ExtrasAreInterpolatedLikeTextureCoordinates) {
  const auto from_object = [](const VertexBlock& block, void*) {
    for (std::size_t i = 0; i < block.count; ++i) {
      for (std::size_t k = 0; k < 8; ++k) block.extras[k][i] = static_cast<float>(k);
      for (std::size_t c = 0; c < 3; ++c) block.extras[c][i] = block.eye[c][i];
    }
  };
  struct Worst {
    std::atomic<float> difference = 0;
  } worst;
  const auto compare = [](const FragmentBlock& block, void* data) {
    Worst& w = *static_cast<Worst*>(data);
    for (std::size_t i = 0; i < block.count; ++i) {
      for (std::size_t c = 0; c < 3; ++c)
        if (block.extras[c][i] != block.eye[c][i]) w.difference = 1;
      for (std::size_t k = 3; k < 8; ++k)
        if (block.extras[k][i] != static_cast<float>(k)) w.difference = 2;
    }
  };
  for (const int samples : {1, 4})
    for (const bool discards : {false, true})
      for (const Shading shading : {Shading::flat, Shading::gouraud, Shading::phong}) {
        FrameBufferFormat format = kFormat;
        format.samples = samples;
        DrawState state = shiny(shading);
        state.vertex_stage = VertexStage{.run = from_object, .reads = {.eye = true}, .extras = 8};
        state.fragment_stage = FragmentStage{.run = compare,
                                             .data = &worst,
                                             .reads = {.color = true, .eye = true, .extras = 8},
                                             .discards = discards};
        picture(format, state);
        EXPECT_EQ(worst.difference, 0.0f) << samples << discards << static_cast<int>(shading);
      }
}

TEST(UserStageOutputs, CapturesObeyDiscards) {
  DrawState state = shiny(Shading::phong);
  state.fragment_stage = FragmentStage{.run =
                                           [](const FragmentBlock& block, void*) {
                                             for (std::size_t i = 0; i < block.count; ++i)
                                               block.keep[i] = block.color[0][i] < 0.4f;
                                           },
                                       .reads = {.color = true},
                                       .discards = true};
  FrameBuffer buffer(kFormat);
  Frame frame(buffer);
  frame.clear({.color = Color{1, 1, 1, 1}, .depth = 1.0});
  frame.set_camera(
      {.view = look_at({0, 0, 3}, {0, 0, 0}, {0, 1, 0}), .projection = perspective(50, 1.5, 0.9, 10)});
  frame.draw(ball().view(), state);
  std::vector<std::uint32_t> draws(pixel_count(buffer)), primitives(pixel_count(buffer));
  std::vector<float> normals(3 * pixel_count(buffer));
  frame.capture({.draw_ids = draws, .primitive_ids = primitives, .normals = normals});
  Renderer().finish(frame);
  const auto colors = colors_of(buffer);
  std::size_t drawn = 0;
  for (std::size_t i = 0; i < colors.size(); ++i) {
    const bool is_drawn = colors[i] != 0xffffff;
    drawn += is_drawn ? 1 : 0;
    EXPECT_EQ(draws[i], is_drawn ? 0u : Capture::kNothing);
    EXPECT_EQ(primitives[i] != Capture::kNothing, is_drawn);
    const float squared = normals[3 * i] * normals[3 * i] + normals[3 * i + 1] * normals[3 * i + 1] +
                          normals[3 * i + 2] * normals[3 * i + 2];
    EXPECT_NEAR(squared, is_drawn ? 1 : 0, 1e-5);
  }
  EXPECT_GT(drawn, 100u);
  EXPECT_LT(drawn, 90u * 60 / 2);
}

}  // namespace
}  // namespace tessera::test::user_stage_outputs_test
