// Draws, clears and accumulations that are left out because of the commands around them, and draws outside
// the view: the bits stay those of the frame in full.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <functional>
#include <vector>

#include "tests/engine/frame/api_support.h"

namespace tessera::frame_elision_test {
namespace {

using namespace test;

using RecordCommands = std::function<void(Frame&)>;

bool is_left_out(const Frame& frame, std::size_t draw, EffectReason reason) {
  const std::vector<EffectNote> notes = frame.effects(draw);
  return std::any_of(notes.begin(), notes.end(), [&](const EffectNote& note) {
    return note.effect == Effect::draw && !note.active && note.reason == reason;
  });
}

FrameBufferFormat small_format() { return {.width = 40, .height = 36, .accumulation_bits = 16}; }

/// Everything that a frame leaves behind.
struct Outcome {
  Fingerprint planes;
  std::vector<std::uint8_t> image;
  FrameStats stats;
};
Outcome outcome(const FrameBufferFormat& format, const RecordCommands& record, bool elide, bool shows) {
  FrameBuffer buffer(format);
  Frame frame(buffer);
  Renderer renderer({.threads = 1, .elide = elide});
  const MeshData window = whole_window(0.4f);
  frame.clear({.color = Color{0.3f, 0.1f, 0.2f, 1}, .depth = 0.9, .stencil = 3, .accumulation = Color{}});
  frame.draw(window.view(), unlit({0.2f, 0.7f, 0.1f, 1}));
  renderer.finish(frame);
  record(frame);
  Outcome result;
  Image image(buffer);
  if (shows) frame.keep({Buffer::color, Buffer::depth, Buffer::stencil, Buffer::accumulation});
  result.stats = shows ? renderer.finish(frame, image.target()) : renderer.finish(frame);
  result.planes = fingerprint(buffer);
  result.image = image.bytes;
  return result;
}

DrawState random_state(Random& random) {
  DrawState state = unlit({random.between(0, 1), random.between(0, 1), random.between(0, 1), 0.5f});
  state.depth.enabled = random.next() % 3 != 0;
  state.depth.write = random.next() % 2 == 0;
  if (random.next() % 3 == 0)
    state.stencil = StencilState{.front = {.func = Compare::lequal, .ref = 2, .zpass = StencilOp::incr}};
  if (random.next() % 3 == 0) state.blend = BlendState{};
  if (random.next() % 4 == 0) state.color_mask = {false, false, false, false};
  if (random.next() % 6 == 0) state.color_mask = {true, false, true, true};
  if (random.next() % 5 == 0) state.scissor = Rect{5, 5, 20, 20};
  return state;
}

Clear random_clear(Random& random) {
  Clear clear;
  if (random.next() % 2 == 0) clear.color = Color{random.between(0, 1), random.between(0, 1), 0.5f, 1};
  if (random.next() % 2 == 0) clear.depth = random.between(0, 1);
  if (random.next() % 2 == 0) clear.stencil = random.next() % 4;
  if (random.next() % 3 == 0) clear.accumulation = Color{random.between(-1, 1), 0.5f, 0, 1};
  if (random.next() % 3 == 0) clear.scissor = Rect{3, 4, 30, 9};
  return clear;
}

Accum random_accumulation(Random& random) {
  Accum accum;
  accum.op = static_cast<AccumOp>(random.next() % 5);
  accum.value = random.between(0, 1);
  if (random.next() % 4 == 0) accum.scissor = Rect{0, 0, 40, 20};
  return accum;
}

void record_random_commands(std::uint64_t seed, std::vector<MeshData>& meshes, Frame& frame) {
  Random random(seed);
  meshes.clear();
  meshes.reserve(16);
  const std::uint32_t commands = 2 + random.next() % 10;
  for (std::uint32_t i = 0; i < commands; ++i) {
    const std::uint32_t kind = random.next() % 5;
    if (kind < 2) {
      const float x = random.between(-1.2f, 0.5f), y = random.between(-1.2f, 0.5f);
      meshes.push_back(
          rectangle(x, y, x + random.between(0.1f, 1), y + random.between(0.1f, 1), random.between(-1, 1)));
      frame.draw(meshes.back().view(), random_state(random));
    } else if (kind < 4) {
      frame.clear(random_clear(random));
    } else {
      frame.accumulate(random_accumulation(random));
    }
  }
  // The kept buffers are read after the frame. Fingerprints need colour and depth.
  if (random.next() % 3 == 0) frame.keep({Buffer::color, Buffer::depth});
}

TEST(FrameElision, KeepsEveryBitOfRandomFrames) {
  int left_out = 0;
  for (std::uint64_t seed = 1; seed <= 3000; ++seed) {
    std::vector<MeshData> meshes;
    FrameBufferFormat format = small_format();
    if (seed % 7 == 0) format.samples = 4;
    if (seed % 5 == 0) format.dither = Dither::bayer4;
    const auto record = [&](Frame& frame) {
      record_random_commands(seed, meshes, frame);
      for (std::size_t draw = 0; draw < frame.draw_count(); ++draw)
        left_out += is_left_out(frame, draw, EffectReason::never_read) ? 1 : 0;
    };
    for (const bool shows : {false, true}) {
      const Outcome full = outcome(format, record, false, shows);
      const Outcome elided = outcome(format, record, true, shows);
      ASSERT_EQ(elided.planes, full.planes) << "seed " << seed;
      ASSERT_EQ(elided.image, full.image) << "seed " << seed;
    }
  }
  std::printf("%d draws left out\n", left_out / 4);
  EXPECT_GE(left_out / 4, 300);
}

TEST(FrameElision, LeavesOutDrawsThatAClearReplaces) {
  FrameBuffer buffer(small_format());
  const MeshData mesh = whole_window();
  DrawState color_only = unlit({1, 0, 0, 1});
  color_only.depth.enabled = false;
  Frame frame(buffer);
  frame.draw(mesh.view(), color_only);
  frame.clear({.color = Color{0, 0, 0, 1}});
  EXPECT_TRUE(is_left_out(frame, 0, EffectReason::never_read));
  frame.reset();

  frame.draw(mesh.view(), color_only);
  frame.clear({.color = Color{0, 0, 0, 1}, .scissor = Rect{0, 0, 39, 36}});
  EXPECT_FALSE(is_left_out(frame, 0, EffectReason::never_read)) << "the clear leaves a column";
  frame.reset();

  frame.draw(mesh.view(), color_only);
  frame.accumulate({.op = AccumOp::load});
  frame.clear({.color = Color{0, 0, 0, 1}});
  EXPECT_FALSE(is_left_out(frame, 0, EffectReason::never_read)) << "it is accumulated";
  frame.reset();

  frame.draw(mesh.view(), unlit({1, 0, 0, 1}));
  frame.clear({.color = Color{0, 0, 0, 1}});
  EXPECT_FALSE(is_left_out(frame, 0, EffectReason::never_read)) << "its depth stays";
}

TEST(FrameElision, RunsNoGeometryOfDrawsThatAClearReplaces) {
  const MeshData mesh = whole_window();
  const auto record = [&](Frame& frame) {
    frame.draw(mesh.view(), unlit({1, 0, 0, 1}));
    frame.clear({.color = Color{0, 0, 0, 1}, .depth = 1.0});
  };
  EXPECT_EQ(outcome(small_format(), record, false, false).stats.triangles_in, 2u);
  EXPECT_EQ(outcome(small_format(), record, true, false).stats.triangles_in, 0u);
}

// The error for a buffer that was not kept does not depend on what is left out.
TEST(FrameElision, StillRefusesToLoadBuffersThatWereNotKept) {
  const MeshData mesh = whole_window();
  for (const bool elide : {false, true}) {
    FrameBuffer buffer(small_format());
    Renderer renderer({.threads = 1, .elide = elide});
    Frame frame(buffer);
    frame.draw(mesh.view(), unlit({1, 0, 0, 1}));
    frame.keep({Buffer::depth});
    renderer.finish(frame);
    frame.draw(mesh.view(), unlit({1, 0, 0, 1}));
    frame.clear({.color = Color{0, 0, 0, 1}, .depth = 1.0});
    EXPECT_TRUE(error_of([&] { renderer.finish(frame); })) << "elide " << elide;
  }
}

/// A cloud of triangles around the origin.
MeshData cloud(Random& random) {
  MeshData mesh;
  for (int i = 0; i < 60; ++i)
    for (int c = 0; c < 3; ++c) mesh.positions.push_back(random.between(-1, 1));
  return mesh;
}

TEST(FrameElision, KeepsEveryBitOfDrawsNearTheEdgesOfTheView) {
  int outside = 0, visible = 0;
  for (std::uint64_t seed = 1; seed <= 2000; ++seed) {
    Random random(seed);
    const MeshData mesh = cloud(random);
    DrawState state = unlit({1, 1, 0, 1});
    if (random.next() % 3 == 0) state.scissor = Rect{10, 8, 9, 11};
    if (random.next() % 4 == 0) state.viewport = Rect{-7, 3, 60, 20};
    state.transform = translate(random.between(-6, 6), random.between(-6, 6), random.between(-25, 5)) *
                      rotate(random.between(0, 360), 1, 2, 3);
    const bool reversed = random.next() % 3 == 0;
    FrameBufferFormat format = small_format();
    format.samples = random.next() % 3 == 0 ? 4 : 1;
    if (reversed) state.depth.test = Compare::greater;
    const auto record = [&](Frame& frame) {
      frame.clear({.color = Color{0, 0, 0, 1}, .depth = reversed ? 0.0 : 1.0});
      frame.set_camera({.projection = random.next() % 2 == 0 ? perspective(50, 1.1, 1, 20, reversed)
                                                             : orthographic(-3, 3, -3, 3, 1, 20, reversed),
                        .reversed = reversed});
      frame.draw(mesh.view(), state);
    };
    Random projection = random;  // both frames draw the same numbers
    const Outcome full = outcome(format, record, false, true);
    random = projection;
    const Outcome elided = outcome(format, record, true, true);
    ASSERT_EQ(elided.planes, full.planes) << "seed " << seed;
    if (elided.stats.triangles_in == 0) ++outside;
    else if (full.stats.binned > 0) ++visible;
  }
  std::printf("%d draws outside, %d visible\n", outside, visible);
  EXPECT_GE(outside, 300);
  EXPECT_GE(visible, 300);
}

TEST(FrameElision, LeavesOutDrawsBeyondOneSide) {
  FrameBuffer buffer(small_format());
  DrawState state = unlit({1, 1, 1, 1});
  const auto is_outside = [&](const MeshData& mesh) {
    Frame frame(buffer);
    frame.draw(mesh.view(), state);
    return is_left_out(frame, 0, EffectReason::outside_view);
  };
  EXPECT_TRUE(is_outside(rectangle(1.01f, -1, 2, 1)));
  EXPECT_FALSE(is_outside(rectangle(0.99f, -1, 2, 1)));
  EXPECT_TRUE(is_outside(rectangle(-1, -1, 1, 1, 1.01f))) << "behind the far plane";
  EXPECT_FALSE(is_outside(rectangle(-1, -1, 1, 1, 1)));
  state.scissor = Rect{0, 0, 20, 36};
  EXPECT_TRUE(is_outside(rectangle(0.1f, -1, 1, 1))) << "right of the scissor";
  state.scissor.reset();
  MeshData lines = rectangle(1.01f, -1, 2, 1);
  lines.primitive = Primitive::lines;
  lines.indices = {0, 1, 2, 3};
  state.line_width = 9;
  EXPECT_FALSE(is_outside(lines)) << "wide lines reach into the window";
}

}  // namespace
}  // namespace tessera::frame_elision_test
