// Contents of a frame buffer after a frame: what is kept, what is discarded, and how much memory it takes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/engine/frame/api_support.h"

namespace tessera::frame_buffer_memory_test {
namespace {

using namespace test;
using testing::AllOf;
using testing::HasSubstr;

const FrameBufferFormat kFormat{.width = 100, .height = 60};
const MeshData kMesh = rectangle(-0.5f, -0.5f, 0.5f, 0.5f);
constexpr Buffer kBuffers[] = {Buffer::color, Buffer::depth, Buffer::stencil};

class FrameBufferMemory : public testing::Test {
 protected:
  Renderer renderer{{.threads = 1}};
  FrameBuffer buffer{kFormat};
  Frame frame{buffer};
  Image image{buffer};

  std::vector<bool> allocated() const {
    std::vector<bool> result;
    for (const Buffer which : kBuffers) result.push_back(buffer.allocated_bytes(which) > 0);
    return result;
  }
  std::optional<std::string> error_of_reading(Buffer which) {
    return error_of([&] {
      if (which == Buffer::color) packed_colors(buffer);
      if (which == Buffer::depth) stored_depths(buffer);
      if (which == Buffer::stencil) stencil_values(buffer);
    });
  }
  std::vector<bool> readable() {
    std::vector<bool> result;
    for (const Buffer which : kBuffers) result.push_back(!error_of_reading(which));
    return result;
  }
};
using Flags = std::vector<bool>;  // colour, depth, stencil

TEST_F(FrameBufferMemory, NewBufferAllocatesNothing) {
  EXPECT_EQ(allocated(), (Flags{false, false, false}));
  EXPECT_EQ(readable(), (Flags{true, true, true}));
  EXPECT_EQ(allocated(), (Flags{false, false, false})) << "reading allocates no planes";
}

TEST_F(FrameBufferMemory, ReadingAPlaneAllocatesItsBuffer) {
  buffer.plane(Buffer::stencil, 0);
  EXPECT_EQ(allocated(), (Flags{false, false, true}));
  EXPECT_GE(buffer.allocated_bytes(Buffer::stencil), 8u * 60 * 13);
}

TEST_F(FrameBufferMemory, ScannedOutFrameAllocatesNothing) {
  frame.clear({.color = Color{0, 0, 1, 1}, .depth = 1.0, .stencil = 0u});
  frame.draw(kMesh.view(), {});
  renderer.finish(frame, image.target());
  EXPECT_EQ(allocated(), (Flags{false, false, false}));
  EXPECT_EQ(readable(), (Flags{false, false, false})) << "nothing was kept";
}

TEST_F(FrameBufferMemory, DrawWithoutDepthAllocatesNoDepthPlanes) {
  DrawState state;
  state.depth.enabled = false;
  frame.draw(kMesh.view(), state);
  state.depth = {.enabled = true, .test = Compare::always, .write = false};
  frame.draw(kMesh.view(), state);
  renderer.finish(frame);
  EXPECT_EQ(allocated(), (Flags{true, false, false}));
  EXPECT_EQ(readable(), (Flags{true, true, true}));
}

TEST_F(FrameBufferMemory, DrawOfDepthAloneAllocatesNoColorPlanes) {
  DrawState state;
  state.color_mask = {false, false, false, false};
  frame.draw(kMesh.view(), state);
  renderer.finish(frame);
  EXPECT_EQ(allocated(), (Flags{false, true, false}));
}

TEST_F(FrameBufferMemory, FullClearsNeedNoPlanes) {
  frame.clear({.color = Color{0.2f, 0.4f, 0.6f, 1}, .depth = 0.5, .stencil = 9u});
  renderer.finish(frame);
  EXPECT_EQ(allocated(), (Flags{false, false, false}));
  EXPECT_EQ(packed_colors(buffer)[5], 0x336699u);
  EXPECT_EQ(stored_depths(buffer)[5], 0x800000u);
  EXPECT_EQ(stencil_values(buffer)[5], 9);
}

TEST_F(FrameBufferMemory, FullClearFreesThePlanes) {
  frame.draw(kMesh.view(), {});
  renderer.finish(frame);
  EXPECT_EQ(allocated(), (Flags{true, true, false}));
  frame.clear({.color = Color{1, 1, 1, 1}, .depth = 1.0});
  renderer.finish(frame);
  EXPECT_EQ(allocated(), (Flags{false, false, false}));
}

TEST_F(FrameBufferMemory, EmptyFrameChangesNothing) {
  frame.draw(kMesh.view(), {});
  renderer.finish(frame);
  const Fingerprint before = fingerprint(buffer);
  EXPECT_EQ(renderer.finish(frame).triangles_in, 0u);
  EXPECT_EQ(fingerprint(buffer), before);
}

TEST_F(FrameBufferMemory, FrameStartsFromTheStoredPicture) {
  frame.clear({.color = Color{0, 0, 1, 1}});
  renderer.finish(frame);
  DrawState in_front = unlit({1, 0, 0, 1});
  frame.draw(kMesh.view(), in_front);
  renderer.finish(frame);
  const MeshData behind = whole_window(0.5f);
  frame.draw(behind.view(), unlit({0, 1, 0, 1}));
  renderer.finish(frame);
  const std::vector<std::uint32_t> words = packed_colors(buffer);
  EXPECT_EQ(words[0], 0x00ff00u) << "over the blue of the first frame";
  EXPECT_EQ(words[30 * 100 + 50], 0xff0000u) << "behind the red of the second";
}

TEST_F(FrameBufferMemory, ErrorsOfDiscardedBuffersNameKeep) {
  frame.clear({.color = Color{}, .depth = 1.0, .stencil = 0u});
  frame.draw(kMesh.view(), {});
  renderer.finish(frame, image.target());
  const char* const names[] = {"colour", "depth", "stencil"};
  for (int i = 0; i < 3; ++i) {
    EXPECT_THAT(error_of_reading(kBuffers[i]).value_or(""), AllOf(HasSubstr("keep"), HasSubstr(names[i])));
    EXPECT_THAT(error_of([&] { buffer.plane(kBuffers[i], 0); }).value_or(""),
                AllOf(HasSubstr("keep"), HasSubstr(names[i])));
  }
  EXPECT_THAT(error_of([&] { buffer.read_color(image.target()); }).value_or(""), HasSubstr("keep"));
}

TEST_F(FrameBufferMemory, ExplicitKeepStoresTheNamedBuffers) {
  frame.clear({.color = Color{}, .depth = 1.0, .stencil = 3u});
  frame.draw(kMesh.view(), {});
  frame.keep({Buffer::color, Buffer::stencil});
  renderer.finish(frame, image.target());
  EXPECT_EQ(readable(), (Flags{true, false, true}));
  Image read(buffer);
  buffer.read_color(read.target());
  EXPECT_EQ(read.bytes, image.bytes);
  EXPECT_EQ(stencil_values(buffer)[0], 3);

  frame.clear({.color = Color{}, .depth = 1.0});
  frame.draw(kMesh.view(), {});
  frame.keep({Buffer::depth});
  renderer.finish(frame);
  EXPECT_EQ(readable(), (Flags{false, true, true})) << "without an image too; the untouched stencil stays";
}

TEST_F(FrameBufferMemory, KeepAppliesToOneFrame) {
  frame.clear({.color = Color{}, .depth = 1.0});
  frame.keep({});
  renderer.finish(frame);
  EXPECT_EQ(readable(), (Flags{false, false, true}));
  frame.clear({.color = Color{}, .depth = 1.0});
  renderer.finish(frame);
  EXPECT_EQ(readable(), (Flags{true, true, true}));
}

TEST_F(FrameBufferMemory, FrameCannotStartFromADiscardedBuffer) {
  frame.clear({.color = Color{}, .depth = 1.0});
  frame.draw(kMesh.view(), {});
  renderer.finish(frame, image.target());

  frame.draw(kMesh.view(), {});
  EXPECT_THAT(error_of([&] { renderer.finish(frame); }).value_or(""),
              AllOf(HasSubstr("keep"), HasSubstr("clear")));
  EXPECT_EQ(frame.draw_count(), 1u) << "the frame is still recorded";

  Frame shown(buffer);
  EXPECT_THAT(error_of([&] { renderer.finish(shown, image.target()); }).value_or(""), HasSubstr("colour"))
      << "an empty frame shows a discarded picture";

  Frame after_color(buffer);
  after_color.clear({.color = Color{}});
  after_color.draw(kMesh.view(), {});
  EXPECT_THAT(error_of([&] { renderer.finish(after_color); }).value_or(""), HasSubstr("depth"));

  Frame after_draw(buffer);
  after_draw.draw(kMesh.view(), unlit({1, 1, 1, 1}));
  after_draw.clear({.color = Color{}, .depth = 1.0});
  EXPECT_THAT(error_of([&] { renderer.finish(after_draw); }).value_or(""), HasSubstr("keep"))
      << "the clear comes too late for the depth test";

  Frame partly(buffer);
  partly.clear({.color = Color{}, .scissor = Rect{0, 0, 99, 60}});
  EXPECT_THAT(error_of([&] { renderer.finish(partly); }).value_or(""), HasSubstr("keep"));

  Frame whole(buffer);
  whole.clear({.color = Color{}, .depth = 1.0, .scissor = Rect{-1, -1, 200, 200}});
  whole.draw(kMesh.view(), {});
  EXPECT_FALSE(error_of([&] { renderer.finish(whole); }))
      << "a scissor that contains the whole buffer makes a full clear";
}

TEST_F(FrameBufferMemory, DiscardedStencilIsReportedBeforeAPixelIsTouched) {
  frame.clear({.stencil = 1u});
  frame.keep({});
  renderer.finish(frame);
  const Fingerprint before = fingerprint(buffer);
  frame.clear({.color = Color{1, 1, 1, 1}, .depth = 0.25});
  frame.draw(kMesh.view(), {});
  frame.clear({.stencil = 2u, .scissor = Rect{0, 0, 5, 5}});
  EXPECT_THAT(error_of([&] { renderer.finish(frame); }).value_or(""),
              AllOf(HasSubstr("stencil"), HasSubstr("clear")));
  EXPECT_EQ(fingerprint(buffer), before);
  EXPECT_EQ(frame.draw_count(), 1u);
}

TEST_F(FrameBufferMemory, UnkeptStencilNeedNotExist) {
  for (int round = 0; round < 2; ++round) {
    frame.clear({.color = Color{}, .stencil = 1u});
    frame.keep({Buffer::color});
    EXPECT_FALSE(error_of([&] { renderer.finish(frame); }));
  }
}

}  // namespace
}  // namespace tessera::frame_buffer_memory_test
