// Indices beyond the vertices, in draws that can change something and in ones that cannot: refused by finish() before anything has changed, or never looked at.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "tests/engine/pixel_support.h"

namespace tessera::test {
namespace {

struct Way {
  const char* name;
  std::function<void(DrawState&)> set;
};
const FrameBufferFormat kFormat{.width = 24, .height = 20};

// Red over all of it, and then a mesh of whose indices many are wrong.
void record(Frame& frame, const MeshData& whole, const MeshData& wrong, const DrawState& state) {
  frame.clear({.color = Color{0, 0, 1, 1}, .depth = 0.75, .stencil = 5});
  frame.draw(whole.view(), unlit({1, 0, 0, 1}));
  frame.draw(wrong.view(), state);
}
MeshData mesh_of(Primitive primitive, std::uint32_t wrong) {
  MeshData mesh = rectangle(-0.5f, -0.5f, 0.5f, 0.5f);
  mesh.primitive = primitive;
  mesh.indices = {0, wrong, 1, 2, 3, wrong, wrong, wrong, 3, 0, 2, wrong};  // makes whole primitives of all kinds
  return mesh;
}

/// Calls check(frame, buffer, wrong index) for a frame of each way and primitive that draws a whole window, then a mesh with that index.
template <std::size_t n, class Check>
void for_each_frame(const Way (&ways)[n], const Check& check) {
  const MeshData whole = rectangle(-1, -1, 1, 1);
  for (const Way& way : ways)
    for (int primitive = 0; primitive <= static_cast<int>(Primitive::polygon); ++primitive)
      for (const std::uint32_t wrong : {1000u, 0x7fffffffu, 0xffffffffu}) {
        SCOPED_TRACE(way.name + std::string(", primitive ") + std::to_string(primitive) + ", index " + std::to_string(wrong));
        const MeshData mesh = mesh_of(static_cast<Primitive>(primitive), wrong);
        DrawState state = unlit({0, 1, 0, 1});
        way.set(state);
        FrameBuffer buffer(kFormat);
        Frame frame(buffer);
        record(frame, whole, mesh, state);
        check(frame, buffer, mesh.indices[1]);
      }
}

TEST(OddIndices, OfDrawsThatChangeNothingAreNotLookedAt) {
  const auto no_depth = [](DrawState& s) { s.depth.write = false; };
  const Way ways[] = {{"masks", [=](DrawState& s) { no_depth(s), s.color_mask = {false, false, false, false}; }},
                      {"planes", [=](DrawState& s) { no_depth(s), s.plane_mask = 0; }},
                      {"masks, stencil that keeps", [=](DrawState& s) { no_depth(s), s.color_mask = {false, false, false, false}, s.stencil = StencilState{}; }},
                      {"masks, stencil without planes", [=](DrawState& s) { no_depth(s), s.plane_mask = 0, s.stencil = StencilState{.front = {.zpass = StencilOp::invert, .write_mask = 0}}; }}};
  const MeshData whole = rectangle(-1, -1, 1, 1);
  FrameBuffer plain(kFormat);
  Frame once(plain);
  once.clear({.color = Color{0, 0, 1, 1}, .depth = 0.75, .stencil = 5});
  once.draw(whole.view(), unlit({1, 0, 0, 1}));
  Renderer({.threads = 1}).finish(once);
  const Fingerprint expected = fingerprint(plain);
  for_each_frame(ways, [&](Frame& frame, const FrameBuffer& buffer, std::uint32_t) {
    EXPECT_EQ(error_of([&] { Renderer({.threads = 1, .count_fragments = true}).finish(frame); }).value_or(""), "");
    EXPECT_EQ(fingerprint(buffer), expected);
  });
}

TEST(OddIndices, OfDrawsThatCanChangeSomethingAreRefusedBeforeAnythingHasChanged) {
  const Way ways[] = {{"colour", [](DrawState&) {}},
                      {"depth alone", [](DrawState& s) { s.color_mask = {false, false, false, false}; }},
                      {"stencil alone", [](DrawState& s) { s.color_mask = {false, false, false, false}, s.depth.write = false, s.stencil = StencilState{.front = {.zpass = StencilOp::incr}}; }}};
  const Fingerprint before = fingerprint(FrameBuffer(kFormat));
  for_each_frame(ways, [&](Frame& frame, const FrameBuffer& buffer, std::uint32_t wrong) {
    EXPECT_THAT(error_of([&] { Renderer({.threads = 1}).finish(frame); }).value_or(""),
                testing::AllOf(testing::StartsWith("Renderer::finish: index 1 of the mesh of draw 1 is "), testing::HasSubstr(std::to_string(wrong))));
    EXPECT_EQ(fingerprint(buffer), before);
    EXPECT_EQ(frame.draw_count(), 2u) << "still recorded";
  });
}

}  // namespace
}  // namespace tessera::test
