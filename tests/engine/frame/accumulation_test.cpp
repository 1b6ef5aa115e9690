// The accumulation buffer through the public interface: operations, keeping, planes and errors.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <memory>

#include "tests/engine/frame/api_random_frame.h"

namespace tessera::accumulation_test {
namespace {

using namespace test;
using testing::HasSubstr;

constexpr FrameBufferFormat kFormat{.width = 133, .height = 71, .alpha_bits = 8, .accumulation_bits = 16};

FrameBufferFormat with_bits(int bits) {
  FrameBufferFormat format = kFormat;
  format.accumulation_bits = bits;
  return format;
}

std::vector<float> accumulated(const FrameBuffer& buffer) {
  std::vector<float> rgba(4 * pixel_count(buffer));
  buffer.read_accumulation(rgba);
  return rgba;
}
// Component c of the pixel at (x, y), with y counted from the top.
float at(const FrameBuffer& buffer, int x, int y, std::size_t c) {
  return accumulated(buffer)[4 * static_cast<std::size_t>(y * buffer.format().width + x) + c];
}
std::uint32_t word_at(const FrameBuffer& buffer, int x, int y) {
  return packed_colors(buffer)[static_cast<std::size_t>(y * buffer.format().width + x)];
}

std::vector<std::uint64_t> plane_hashes(const FrameBuffer& buffer) {
  std::vector<std::uint64_t> hashes;
  for (int k = 0; k < buffer.plane_count(Buffer::accumulation); ++k)
    hashes.push_back(hash_of(buffer.plane(Buffer::accumulation, k)));
  return hashes;
}

class Accumulating : public testing::Test {
 protected:
  Renderer renderer{{.threads = 1}};
  FrameBuffer buffer{kFormat};
  Frame frame{buffer};
};

TEST_F(Accumulating, BlursMotionBetweenTwoFrames) {
  const MeshData left = rectangle(-0.8f, -0.5f, 0.2f, 0.5f);
  const MeshData right = rectangle(-0.2f, -0.5f, 0.8f, 0.5f);
  frame.clear({.color = Color{0, 0, 0, 1}, .depth = 1.0});
  frame.draw(left.view(), unlit({1, 1, 1, 1}));
  frame.accumulate({.op = AccumOp::load, .value = 0.5});
  frame.keep({Buffer::accumulation});
  renderer.finish(frame);
  frame.clear({.color = Color{0, 0, 0, 1}, .depth = 1.0});
  frame.draw(right.view(), unlit({1, 1, 1, 1}));
  frame.accumulate({.value = 0.5});
  frame.accumulate({.op = AccumOp::return_color});
  frame.keep({Buffer::color});
  renderer.finish(frame);
  EXPECT_EQ(word_at(buffer, 30, 35), 0xff808080u) << "first frame only";
  EXPECT_EQ(word_at(buffer, 66, 35), 0xffffffffu) << "both";
  EXPECT_EQ(word_at(buffer, 100, 35), 0xff808080u) << "second frame only";
  EXPECT_EQ(word_at(buffer, 5, 35), 0xff000000u) << "neither";
}

TEST_F(Accumulating, RespectsTheScissorToThePixel) {
  frame.clear({.color = Color{1, 0.5f, 0, 1}, .accumulation = Color{0.25f, 0.25f, 0.25f, 0.25f}});
  frame.clear({.accumulation = Color{-1, -1, -1, -1}, .scissor = Rect{61, 3, 7, 5}});
  frame.accumulate({.op = AccumOp::add, .value = 0.5, .scissor = Rect{30, 10, 41, 31}});
  renderer.finish(frame);
  // Rows from the top: window y 10 .. 40 are rows 30 .. 60, y 3 .. 7 rows 63 .. 67.
  const std::vector<float> rgba = accumulated(buffer);
  std::size_t i = 0;
  for (int y = 0; y < kFormat.height; ++y)
    for (int x = 0; x < kFormat.width; ++x) {
      const bool added = x >= 30 && x < 71 && y >= 30 && y < 61;
      const bool cleared = x >= 61 && x < 68 && y >= 63 && y < 68;
      double expected = 0.25;
      if (cleared) expected = -1;
      if (added) expected = 0.75;
      for (int c = 0; c < 4; ++c) ASSERT_NEAR(rgba[i++], expected, 1e-4) << x << ", " << y;
    }
}

TEST_F(Accumulating, StoresThePlanesOfItsComponentsInOrder) {
  frame.clear({.accumulation = Color{0.25f, -0.25f, 1, -1}});
  renderer.finish(frame);
  EXPECT_EQ(buffer.allocated_bytes(Buffer::accumulation), 0u) << "one colour needs no planes";
  ASSERT_EQ(buffer.plane_count(Buffer::accumulation), 64);
  const std::uint16_t levels[] = {8192, static_cast<std::uint16_t>(-8192), 32767,
                                  static_cast<std::uint16_t>(-32767)};
  for (int k = 0; k < 64; ++k) {
    const PlaneView plane = buffer.plane(Buffer::accumulation, k);
    EXPECT_EQ(plane.bits[0], (levels[k / 16] >> k % 16 & 1) != 0 ? 0xff : 0) << k;
  }
  EXPECT_GE(buffer.allocated_bytes(Buffer::accumulation), 64u * 71 * 17);
  EXPECT_THAT(error_of([&] { buffer.plane(Buffer::accumulation, 64); }).value_or(""),
              HasSubstr("plane 64 of the accumulation buffer, which has planes 0 to 63"));
}

TEST_F(Accumulating, RunsInRecordingOrder) {
  // Clears and accumulations before the same draw, and after the last.
  const MeshData mesh = rectangle(-1, -1, 0, 1);
  frame.clear({.color = Color{1, 1, 1, 1}});
  frame.accumulate({.op = AccumOp::load, .value = 0.5});
  frame.clear({.color = Color{0, 0, 0, 1}, .depth = 1.0});
  frame.accumulate({.value = 0.25});  // adds black, so only alpha changes
  frame.accumulate({.op = AccumOp::mult, .value = 0.5});
  frame.clear({.color = Color{0, 0, 1, 1}});
  frame.draw(mesh.view(), unlit({0, 1, 0, 1}));
  frame.accumulate({.value = 0.5});
  frame.clear({.color = Color{1, 1, 1, 0}});
  renderer.finish(frame);
  const auto expect_pixel = [&](int x, std::array<double, 4> rgba) {
    for (std::size_t c = 0; c < 4; ++c)
      EXPECT_NEAR(at(buffer, x, 20, c), rgba[c], 1e-4) << x << ", component " << c;
  };
  expect_pixel(10, {0.25, 0.75, 0.25, 0.875});
  expect_pixel(120, {0.25, 0.25, 0.75, 0.875});
  EXPECT_EQ(word_at(buffer, 10, 20), 0x00ffffffu) << "the last clear";
}

TEST_F(Accumulating, ReachesTilesWithoutTriangles) {
  Image image(buffer);
  const MeshData mesh = rectangle(-1, 0.9f, -0.9f, 1);
  frame.clear({.color = Color{1, 1, 1, 1}, .depth = 1.0});
  frame.draw(mesh.view(), unlit({0, 0, 0, 1}));
  frame.accumulate({.op = AccumOp::load, .value = 0.5});
  frame.accumulate({.op = AccumOp::return_color});
  renderer.finish(frame, image.target());
  EXPECT_EQ(image.bytes.back(), 128) << "alpha";
  EXPECT_EQ(image.bytes[image.bytes.size() - 4], 128);
  EXPECT_EQ(image.bytes[0], 0);
  EXPECT_EQ(buffer.allocated_bytes(Buffer::color) + buffer.allocated_bytes(Buffer::accumulation), 0u);
}

TEST_F(Accumulating, ReturnRespectsTheColorMask) {
  frame.clear({.color = Color{0, 0, 0, 0}, .accumulation = Color{1, 1, 1, 1}});
  frame.accumulate({.op = AccumOp::return_color,
                    .scissor = Rect{0, 0, 40, 71},
                    .color_mask = {true, false, false, false}});
  frame.accumulate({.op = AccumOp::return_color,
                    .scissor = Rect{40, 0, 40, 71},
                    .color_mask = {false, true, false, true}});
  frame.accumulate({.op = AccumOp::return_color, .value = -1, .scissor = Rect{80, 0, 40, 71}});
  renderer.finish(frame);
  EXPECT_EQ(word_at(buffer, 20, 20), 0x00ff0000u);
  EXPECT_EQ(word_at(buffer, 60, 20), 0xff00ff00u);
  EXPECT_EQ(word_at(buffer, 100, 20), 0u) << "clamped";
  EXPECT_EQ(word_at(buffer, 130, 20), 0u) << "no command";
}

TEST_F(Accumulating, ReturnDithersLikeEveryOtherWrite) {
  for (const int color_bits : {2, 8, 24}) {
    FrameBuffer dithered({.width = 70,
                          .height = 41,
                          .color_bits = color_bits,
                          .dither = Dither::bayer8,
                          .accumulation_bits = 32});
    Frame f(dithered);
    const Color color{0.2987f, 0.4321f, 0.7123f, 1};
    f.clear({.color = color});
    renderer.finish(f);
    const std::vector<std::uint32_t> cleared = packed_colors(dithered);
    f.clear({.color = Color{0, 0, 0, 1}, .accumulation = color});
    f.accumulate({.op = AccumOp::return_color});
    renderer.finish(f);
    EXPECT_EQ(packed_colors(dithered), cleared) << color_bits;
  }
}

TEST_F(Accumulating, ReadsAlphaOneWithoutAlphaPlanesAndGreyFromLuminance) {
  FrameBuffer gray({.width = 20, .height = 20, .color_bits = 2, .accumulation_bits = 32});
  Frame grays(gray);
  grays.clear({.color = Color{0.7f, 0.7f, 0.7f, 0}});  // level 2 of 3
  grays.accumulate({.value = -0.5});
  renderer.finish(grays);
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(at(gray, 3, 3, c), -1 / 3.0, 1e-7);
  EXPECT_NEAR(at(gray, 3, 3, 3), -0.5, 1e-7);
}

TEST_F(Accumulating, AllocatesNothingIfNothingAccumulates) {
  Image image(buffer);
  frame.clear({.color = Color{0, 0, 0, 1}, .accumulation = Color{1, 1, 1, 1}});
  // A partial clear, so that tiles are processed.
  frame.clear({.color = Color{1, 0, 0, 1}, .scissor = Rect{5, 5, 9, 9}});
  renderer.finish(frame, image.target());
  frame.clear({.accumulation = Color{0, 0, 0, 0}});
  renderer.finish(frame);
  frame.clear({.color = Color{0, 0, 0, 1}, .depth = 1.0});
  renderer.finish(frame);
  EXPECT_EQ(buffer.allocated_bytes(Buffer::accumulation), 0u);
  EXPECT_EQ(at(buffer, 0, 0, 0), 0);
  frame.accumulate({.op = AccumOp::add, .value = 0.5});
  renderer.finish(frame);
  EXPECT_GT(buffer.allocated_bytes(Buffer::accumulation), 0u);
  EXPECT_NEAR(at(buffer, 132, 70, 3), 0.5, 1e-4);
  frame.clear({.accumulation = Color{0, 0, 0, 0}});
  renderer.finish(frame);
  EXPECT_EQ(buffer.allocated_bytes(Buffer::accumulation), 0u) << "a full clear frees the planes";
}

TEST_F(Accumulating, DiscardedContentIsReported) {
  Image image(buffer);
  frame.clear({.color = Color{1, 0, 0, 1}});
  frame.accumulate({.value = 0.5});
  renderer.finish(frame, image.target());
  EXPECT_THAT(error_of([&] { accumulated(buffer); }).value_or(""),
              HasSubstr("did not keep the accumulation buffer"));
  frame.clear({.color = Color{1, 0, 0, 1}});
  frame.accumulate({.value = 0.5});
  EXPECT_THAT(error_of([&] { renderer.finish(frame); }).value_or(""),
              HasSubstr("starts from the accumulation buffer"));
  frame.reset();
  frame.accumulate({.op = AccumOp::load});
  EXPECT_THAT(error_of([&] { renderer.finish(frame); }).value_or(""),
              HasSubstr("starts from the colour buffer"))
      << "accumulation reads it";
  frame.reset();
  frame.clear({.accumulation = Color{0.5f, 0.5f, 0.5f, 0.5f}});
  frame.accumulate({.op = AccumOp::return_color, .scissor = Rect{0, 0, 5, 5}});
  EXPECT_THAT(error_of([&] { renderer.finish(frame); }).value_or(""),
              HasSubstr("starts from the colour buffer"))
      << "part of it remains";
  frame.reset();
  // Both are replaced before anything reads them.
  frame.clear({.accumulation = Color{0.5f, 0.5f, 0.5f, 0.5f}});
  frame.accumulate({.op = AccumOp::return_color});
  frame.accumulate({.op = AccumOp::load, .value = -1});
  renderer.finish(frame);
  EXPECT_EQ(word_at(buffer, 132, 70), 0x80808080u);
  EXPECT_NEAR(at(buffer, 132, 70, 2), -128 / 255.0, 1e-4);
  frame.accumulate({});
  frame.keep({Buffer::color});
  renderer.finish(frame);
  frame.accumulate({.op = AccumOp::load, .value = 0.5});
  renderer.finish(frame);
  EXPECT_NEAR(at(buffer, 132, 70, 2), 64 / 255.0, 1e-4);
}

TEST_F(Accumulating, DoesNotChangeCaptures) {
  std::vector<std::uint32_t> draw_ids(pixel_count(buffer));
  const MeshData mesh = rectangle(-1, -1, 0, 1);
  frame.clear({.color = Color{0, 0, 0, 1}, .depth = 1.0, .accumulation = Color{1, 1, 1, 1}});
  frame.draw(mesh.view(), unlit({0, 1, 0, 1}));
  frame.accumulate({.op = AccumOp::add, .value = -0.5});
  frame.accumulate({.op = AccumOp::return_color});
  frame.capture({.draw_ids = draw_ids});
  renderer.finish(frame);
  EXPECT_EQ(draw_ids[10], 0u);
  EXPECT_EQ(draw_ids[130], Capture::kNothing);
  EXPECT_EQ(word_at(buffer, 10, 0), 0x80808080u);
  EXPECT_NEAR(at(buffer, 10, 0, 1), 0.5, 1e-4);
}

// Draws and commands of every kind whose order affects the result.
std::vector<std::function<void(Frame&)>> commands_of(const RandomFrame& scene) {
  const auto draw = [&scene](Color color, double x, Shading shading) {
    return [&scene, color, x, shading](Frame& f) {
      DrawState state = unlit(color);
      state.lighting = shading == Shading::phong;
      state.shading = shading;
      state.transform = translate(x, 0, 0);
      f.set_camera(scene.camera);
      f.draw(scene.triangles.view(), state);
    };
  };
  const auto accum = [](Accum a) { return [a](Frame& f) { f.accumulate(a); }; };
  const auto clear = [](Clear c) { return [c](Frame& f) { f.clear(c); }; };
  return {clear({.color = Color{0.1f, 0.2f, 0.3f, 0.4f},
                 .depth = 1.0,
                 .accumulation = Color{0.1f, -0.2f, 0, 0.3f}}),
          draw({1, 0.5f, 0.2f, 0.7f}, 0, Shading::phong),
          accum({.value = 0.3}),
          clear({.color = Color{0.9f, 0.8f, 0.1f, 0.2f}, .depth = 1.0, .scissor = Rect{17, 9, 300, 40}}),
          accum({.op = AccumOp::load, .value = -0.4, .scissor = Rect{40, 5, 33, 50}}),
          draw({0, 0.7f, 0.9f, 1}, 0.5, Shading::gouraud),
          accum({.value = 0.6}),
          accum({.op = AccumOp::mult, .value = -1.3, .scissor = Rect{-5, -5, 80, 40}}),
          accum({.op = AccumOp::return_color,
                 .value = 1.7,
                 .scissor = Rect{11, 13, 100, 41},
                 .color_mask = {true, true, false, true}}),
          accum({.op = AccumOp::add, .value = 0.05}),
          clear({.accumulation = Color{0.5f, 0.6f, 0.7f, 0.8f}, .scissor = Rect{100, 50, 20, 20}}),
          draw({0.6f, 0.1f, 0.9f, 0.5f}, -0.5, Shading::flat),
          accum({.value = 0.9}),
          accum({.op = AccumOp::return_color, .value = 0.8, .scissor = Rect{60, 0, 60, 71}})};
}

TEST(FrameAccumulation, BitsAreTheSameForEveryRendererOptionAndEverySplitOfTheFrame) {
  for (const int bits : {16, 32})
    for (const Dither dither : {Dither::none, Dither::bayer4}) {
      FrameBufferFormat format = with_bits(bits);
      format.dither = dither;
      if (dither == Dither::none)
        format.alpha_bits = 0;  // without operations after shading, so shading is deferred
      const RandomFrame scene(format, 150);
      std::optional<Fingerprint> expected;
      std::vector<std::uint64_t> expected_planes;
      for (const int tile_size : {32, 64, 128})
        for (const int threads : {1, 3})
          for (const InstructionSet set : available_instruction_sets())
            for (const bool cut : {false, true}) {
              if (set != InstructionSet::scalar && set != InstructionSet::avx2) continue;
              Renderer renderer({.threads = threads, .tile_size = tile_size, .instruction_set = set});
              FrameBuffer buffer(format);
              Frame frame(buffer);
              for (const auto& command : commands_of(scene)) {
                command(frame);
                if (cut) renderer.finish(frame);
              }
              if (!cut) renderer.finish(frame);
              if (!expected) {
                expected = fingerprint(buffer);
                expected_planes = plane_hashes(buffer);
              }
              EXPECT_EQ(fingerprint(buffer), *expected)
                  << tile_size << ", " << threads << " threads, " << name(set) << (cut ? ", cut" : "");
              EXPECT_EQ(plane_hashes(buffer), expected_planes)
                  << tile_size << ", " << threads << " threads, " << name(set) << (cut ? ", cut" : "");
            }
    }
}

TEST(FrameAccumulation, FollowsStencilInCallerMemory) {
  for (const int bits : {16, 32}) {
    const FrameBufferFormat format = with_bits(bits);
    const std::size_t size = FrameBuffer::memory_bytes(format);
    EXPECT_GE(size - FrameBuffer::memory_bytes(with_bits(0)), static_cast<std::size_t>(4 * bits * 71 * 17));
    const std::unique_ptr<std::byte[], void (*)(std::byte*)> memory(
        static_cast<std::byte*>(::operator new[](size, std::align_val_t{64})),
        [](std::byte* at) { ::operator delete[](at, std::align_val_t{64}); });
    std::fill_n(memory.get(), size, std::byte{0xcd});
    FrameBuffer own(format);
    FrameBuffer lent(format, {memory.get(), size});
    EXPECT_EQ(plane_hashes(own), plane_hashes(lent)) << "new buffer";
    Renderer renderer({.threads = 2});
    const RandomFrame scene(format, 50);
    for (FrameBuffer* buffer : {&own, &lent}) {
      Frame frame(*buffer);
      for (const auto& command : commands_of(scene)) command(frame);
      renderer.finish(frame);
    }
    EXPECT_EQ(plane_hashes(own), plane_hashes(lent));
    EXPECT_EQ(fingerprint(own), fingerprint(lent));
    const auto* const first = reinterpret_cast<const std::byte*>(lent.plane(Buffer::accumulation, 0).bits);
    EXPECT_EQ(first, memory.get() + FrameBuffer::memory_bytes(with_bits(0)));
    Frame frame(lent);
    frame.clear({.accumulation = Color{1, 0, 0, 0}});
    renderer.finish(frame);
    EXPECT_EQ(*first, std::byte{0xff}) << "clears are visible at once";
  }
}

TEST(FrameAccumulation, InvalidUsesAreRefused) {
  const auto message_of = [](const std::function<void()>& act) { return error_of(act).value_or("no error"); };
  EXPECT_THAT(message_of([] { FrameBuffer({.accumulation_bits = 8}); }),
              HasSubstr("accumulation_bits is 8, must be 0, 16 or 32"));
  EXPECT_THAT(message_of([] {
                FrameBuffer({.color_mode = ColorMode::index, .color_bits = 8, .accumulation_bits = 16});
              }),
              HasSubstr("colour mode is index"));
  FrameBuffer without({.width = 8, .height = 8});
  FrameBuffer index({.width = 8, .height = 8, .color_mode = ColorMode::index, .color_bits = 8});
  FrameBuffer gray({.width = 8, .height = 8, .color_bits = 2, .accumulation_bits = 16});
  Frame none(without);
  Frame indices(index);
  Frame grays(gray);
  EXPECT_THAT(message_of([&] { none.accumulate({}); }), HasSubstr("has no accumulation buffer"));
  EXPECT_THAT(message_of([&] { none.clear({.accumulation = Color{}}); }),
              HasSubstr("has no accumulation buffer"));
  EXPECT_THAT(message_of([&] { without.read_accumulation({}); }), HasSubstr("0 elements"));
  std::vector<float> rgba(256);
  EXPECT_THAT(message_of([&] { without.read_accumulation(rgba); }), HasSubstr("has no accumulation buffer"));
  EXPECT_THAT(message_of([&] { indices.accumulate({}); }), HasSubstr("indices"));
  EXPECT_THAT(message_of([&] { grays.accumulate({.value = std::numeric_limits<double>::quiet_NaN()}); }),
              HasSubstr("value holds nan, must be finite"));
  EXPECT_THAT(message_of([&] { grays.accumulate({.value = std::numeric_limits<double>::infinity()}); }),
              HasSubstr("must be finite"));
  EXPECT_THAT(message_of([&] { grays.accumulate({.scissor = Rect{0, 0, -1, 4}}); }), HasSubstr("scissor"));
  EXPECT_THAT(message_of([&] {
                grays.accumulate({.color_mask = {true, false, true, true}});
              }),
              HasSubstr("luminance alone"));
  EXPECT_THAT(message_of([&] {
                grays.clear({.accumulation = Color{0, 0, 1.5f, 0}});
              }),
              HasSubstr("accumulation is 1.5, must be -1 to 1"));
  EXPECT_EQ(message_of([&] { grays.accumulate({.color_mask = {false, false, false, true}}); }), "no error");
}

}  // namespace
}  // namespace tessera::accumulation_test
