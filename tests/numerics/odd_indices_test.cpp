// Out-of-range indices, in draws that can change something and in draws that cannot, are rejected by
// `Frame::draw`, and the frame is unchanged.
#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "tests/engine/frame/pixel_support.h"

namespace tessera::test::odd_indices_test {
namespace {

struct Way {
  const char* name;
  std::function<void(DrawState&)> set;
};
const FrameBufferFormat kFormat{.width = 24, .height = 20};

MeshData mesh_of(Primitive primitive, std::uint32_t wrong) {
  MeshData mesh = rectangle(-0.5f, -0.5f, 0.5f, 0.5f);
  mesh.primitive = primitive;
  // Whole primitives of all kinds.
  mesh.indices = {0, wrong, 1, 2, 3, wrong, wrong, wrong, 3, 0, 2, wrong};
  return mesh;
}

TEST(OddIndices, AreRejectedWhateverTheDrawWouldChange) {
  const auto no_depth = [](DrawState& s) { s.depth.write = false; };
  const Way ways[] = {{"colour", [](DrawState&) {}},
                      {"depth alone",
                       [](DrawState& s) {
                         s.color_mask = {false, false, false, false};
                       }},
                      {"stencil alone",
                       [=](DrawState& s) {
                         no_depth(s), s.color_mask = {false, false, false, false},
                                      s.stencil = StencilState{.front = {.zpass = StencilOp::incr}};
                       }},
                      {"nothing, by masks",
                       [=](DrawState& s) {
                         no_depth(s);
                         s.color_mask = {false, false, false, false};
                       }},
                      {"nothing, by planes",
                       [=](DrawState& s) {
                         no_depth(s);
                         s.plane_mask = 0;
                       }},
                      {"nothing, by a stencil that keeps",
                       [=](DrawState& s) {
                         no_depth(s);
                         s.color_mask = {false, false, false, false};
                         s.stencil = StencilState{};
                       }},
                      {"nothing, by a stencil without planes", [=](DrawState& s) {
                         no_depth(s);
                         s.plane_mask = 0;
                         s.stencil = StencilState{.front = {.zpass = StencilOp::invert, .write_mask = 0}};
                       }}};
  const MeshData whole = rectangle(-1, -1, 1, 1);
  Renderer renderer({.threads = 1, .debug = {.count_fragments = true}});
  const auto begin = [&](Frame& frame) {
    frame.clear({.color = Color{0, 0, 1, 1}, .depth = 0.75, .stencil = 5});
    frame.draw(whole.view(), unlit({1, 0, 0, 1}));
  };
  FrameBuffer plain(kFormat);
  Frame once(plain);
  begin(once);
  renderer.finish(once);
  const Fingerprint expected = fingerprint(plain);
  for (const Way& way : ways)
    for (int primitive = 0; primitive <= static_cast<int>(Primitive::polygon); ++primitive)
      for (const std::uint32_t wrong : {4u, 1000u, 0x7fffffffu, 0xffffffffu}) {
        SCOPED_TRACE(way.name + std::string(", primitive ") + std::to_string(primitive) + ", index " +
                     std::to_string(wrong));
        const MeshData mesh = mesh_of(static_cast<Primitive>(primitive), wrong);
        DrawState state = unlit({0, 1, 0, 1});
        way.set(state);
        FrameBuffer buffer(kFormat);
        Frame frame(buffer);
        begin(frame);
        EXPECT_EQ(error_of([&] { frame.draw(mesh.view(), state); }).value_or(""),
                  "Frame::draw: index 1 of the mesh is " + std::to_string(wrong) +
                      ", must be below the number of vertices, 4");
        EXPECT_EQ(frame.draw_count(), 1u);
        renderer.finish(frame);
        EXPECT_EQ(fingerprint(buffer), expected);
      }
}

}  // namespace
}  // namespace tessera::test::odd_indices_test
