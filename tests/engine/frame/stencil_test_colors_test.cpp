// A stencil test only selects pixels: those that pass have the same colour and depth as without the test.
#include <gtest/gtest.h>

#include <optional>
#include <utility>

#include "tests/engine/frame/pixel_support.h"

namespace tessera::stencil_test_colors_test {
namespace {

using namespace test;

// Large triangles, and triangles so small that many lie between pixels, of either winding; each vertex has a
// colour and a normal.
MeshData some_triangles() {
  Random random(11);
  MeshData mesh;
  for (int i = 0; i < 1500; ++i) {
    float extent = i % 3 == 0 ? 0.2f : 0.04f;
    if (i % 50 == 0) extent = 1.5f;
    const float center[3] = {random.between(-1, 1), random.between(-1, 1), random.between(-0.9f, 0.9f)};
    for (int k = 0; k < 3; ++k) {
      for (const float c : center)
        mesh.positions.push_back(c + extent * random.between(-0.5f, 0.5f) * (&c == center + 2 ? 0.1f : 1.0f));
      for (int c = 0; c < 4; ++c) mesh.colors.push_back(random.between(0, 1));
      for (int c = 0; c < 3; ++c) mesh.normals.push_back(random.between(-1, 1));
    }
  }
  return mesh;
}

struct Stored {
  std::vector<std::uint32_t> words;
  std::vector<float> depth;
};
Stored drawn(const FrameBufferFormat& format, const MeshData& mesh, const DrawState& state,
             const RendererOptions& options, const MeshData* masked = nullptr) {
  FrameBuffer buffer(format);
  Frame frame(buffer);
  frame.clear({.color = Color{0, 0, 0, 1},
               .depth = format.depth == DepthFormat::none ? std::nullopt : std::optional(1.0),
               .stencil = 0u});
  if (masked != nullptr) {
    DrawState marks = unlit({1, 1, 1, 1});
    marks.color_mask = {false, false, false, false};
    marks.depth.enabled = false;
    marks.stencil = StencilState{.front = {.zpass = StencilOp::invert, .write_mask = 1}};
    frame.draw(masked->view(), marks);
  }
  frame.set_light_model({.two_sided = true});
  frame.draw(mesh.view(), state);
  Renderer(options).finish(frame);
  Stored stored{.words = packed_colors(buffer), .depth = {}};
  stored.depth.resize(stored.words.size());
  if (format.depth != DepthFormat::none) buffer.read_depth(stored.depth);
  return stored;
}

TEST(StencilTestColors, MatchThoseWithoutTheTest) {
  const MeshData mesh = some_triangles();
  std::vector<FrameBufferFormat> formats(5, {.width = 130, .height = 97});
  formats[1].color_bits = 16;
  formats[1].depth = DepthFormat::float32;
  formats[2].color_mode = ColorMode::index;
  formats[2].color_bits = 8;
  formats[2].depth = DepthFormat::unorm32;
  formats[3].depth = DepthFormat::none;
  formats[4].samples = 4;
  MeshData marks;  // every second stripe
  for (int k = -20; k < 20; k += 2) {
    const float y0 = static_cast<float>(k) / 20;
    const float y1 = static_cast<float>(k + 1) / 20;
    for (const auto& [x, y] :
         {std::pair{-1.0f, y0}, {1.0f, y0}, {1.0f, y1}, {-1.0f, y0}, {1.0f, y1}, {-1.0f, y1}})
      marks.positions.insert(marks.positions.end(), {x, y, 0.0f});
  }
  for (const FrameBufferFormat& format : formats)
    for (const bool lit : {false, true})
      for (const Shading shading : {Shading::flat, Shading::gouraud, Shading::phong})
        for (const int tile_size : {32, 128}) {
          SCOPED_TRACE(testing::Message() << describe(format) << (lit ? ", lit " : ", unlit ")
                                          << static_cast<int>(shading) << ", tiles of " << tile_size);
          DrawState state;
          state.lighting = lit;
          state.shading = shading;
          const RendererOptions options{.threads = 1, .tile_size = tile_size};
          const Stored plain = drawn(format, mesh, state, options);
          // Every fragment increments; fronts and backs use different operations.
          state.stencil =
              StencilState{.front = {.func = Compare::gequal,
                                     .ref = 255,
                                     .zfail = StencilOp::decr_wrap,
                                     .zpass = StencilOp::incr_wrap},
                           .back = StencilFace{.func = Compare::always, .zpass = StencilOp::decr_wrap}};
          const Stored counted = drawn(format, mesh, state, options);
          EXPECT_EQ(counted.words, plain.words);
          EXPECT_EQ(counted.depth, plain.depth);
          // Fronts only: backs store nothing.
          state.stencil->back->func = Compare::never;
          DrawState front_faces = state;
          front_faces.stencil.reset();
          front_faces.cull = Cull::back;
          EXPECT_EQ(drawn(format, mesh, state, options).words,
                    drawn(format, mesh, front_faces, options).words);
          if (format.samples > 1) continue;  // edges of the stripes cross pixels
          // Fronts in every second stripe.
          state.stencil.reset();
          state.cull = Cull::back;
          const Stored fronts = drawn(format, mesh, state, options);
          const Stored nothing = drawn(format, {}, state, options);
          const Stored stripes = drawn(format, marks, unlit({1, 1, 1, 1}), options);
          state.stencil = StencilState{.front = {.func = Compare::equal, .ref = 1, .mask = 1}};
          const Stored marked = drawn(format, mesh, state, options, &marks);
          Stored expected = nothing;
          for (std::size_t i = 0; i < expected.words.size(); ++i)
            if (stripes.words[i] != nothing.words[i]) {
              expected.words[i] = fronts.words[i];
              expected.depth[i] = fronts.depth[i];
            }
          EXPECT_EQ(marked.words, expected.words);
          EXPECT_EQ(marked.depth, expected.depth);
          EXPECT_NE(marked.words, nothing.words);
          EXPECT_NE(marked.words, fronts.words);
        }
}

}  // namespace
}  // namespace tessera::stencil_test_colors_test
