// The caller's floating-point mode neither changes a bit nor is changed.
#include <gtest/gtest.h>

#if defined(__x86_64__)

#include <immintrin.h>

#include <chrono>
#include <filesystem>
#include <thread>

#include "engine/program/scene/scene.h"
#include "engine/program/threads/thread_limit.h"
#include "engine/runtime/floating_point_mode.h"
#include "engine/runtime/worker_pool.h"
#include "tests/engine/frame/api_random_frame.h"

namespace tessera::renderer_floating_point_test {
using namespace detail;
using namespace program;
namespace {

using namespace test;

constexpr unsigned kFlushToZero = 0x8000;
constexpr unsigned kDenormalsAreZero = 0x40;
constexpr unsigned kRoundUp = 0x4000;
constexpr unsigned kRoundDown = 0x2000;
constexpr unsigned kModeBits = 0xffc0;
constexpr unsigned kMasks = 0x1f80;
constexpr unsigned kModes[] = {kMasks | kFlushToZero | kDenormalsAreZero, kMasks | kRoundUp,
                               kMasks | kRoundDown, kMasks | kFlushToZero | kDenormalsAreZero | kRoundUp};

/// A mode other than the default, as a host program or its plug-ins may leave it.
class HostMode {
 public:
  explicit HostMode(unsigned mode) : saved_(_mm_getcsr()), mode_(mode) { _mm_setcsr(mode); }
  ~HostMode() { _mm_setcsr(saved_); }
  bool untouched() const { return (_mm_getcsr() & kModeBits) == mode_; }

 private:
  unsigned saved_;
  unsigned mode_;
};

// Many products of these matrices and colours are denormal or lie between two floats.
void record(const RandomFrame& random, Frame& frame) {
  random.record(frame);
  DrawState state;
  state.transform = scale(1e-20, 1e-20, 1);
  state.material.diffuse = {1e-38f, 1e-20f, 0.3f, 1};
  Material back = state.material;
  back.specular = {1e-30f, 1, 1, 1};
  state.back_material = back;
  frame.draw(random.triangles.view(), state);
}

void expect_same_bits_in_every_mode(RendererOptions options, const FrameBufferFormat& format) {
  const ThreadLimit limit(4);
  Renderer renderer(options);
  const RandomFrame random(format, 400);
  FrameBuffer plain(format);
  Frame frame(plain);
  record(random, frame);
  renderer.finish(frame);
  const Fingerprint expected = fingerprint(plain);
  for (const unsigned mode : kModes) {
    FrameBuffer buffer(format);
    FrameBuffer presented(format);
    Frame odd(buffer);
    Frame shown(presented);
    Image image(presented);
    Image expected_image(plain);
    record(random, odd);
    record(random, shown);
    bool untouched = false;
    {
      const HostMode host(mode);
      renderer.finish(odd);
      renderer.finish(shown, image.target());
      untouched = host.untouched();
    }
    EXPECT_TRUE(untouched) << "the mode is " << std::hex << mode;
    EXPECT_EQ(fingerprint(buffer), expected) << "mode " << std::hex << mode;
    plain.read_color(expected_image.target());
    EXPECT_TRUE(image.bytes == expected_image.bytes) << "mode " << std::hex << mode;
  }
}

TEST(FloatingPointModeOfTheCaller, ChangesNoBitOnAnyInstructionSetAndThreadCount) {
  for (const InstructionSet set : available_instruction_sets())
    for (const int threads : {1, 4}) {
      SCOPED_TRACE(std::string(name(set)) + ", " + std::to_string(threads) + " threads");
      expect_same_bits_in_every_mode({.threads = threads, .instruction_set = set},
                                     {.width = 140, .height = 90});
      expect_same_bits_in_every_mode(
          {.threads = threads, .instruction_set = set},
          {.width = 140, .height = 90, .color_bits = 16, .depth = DepthFormat::float32});
    }
}

TEST(FloatingPointModeOfTheCaller, ChangesNoBitOfIndexBuffers) {
  expect_same_bits_in_every_mode({.threads = 1}, {.width = 140,
                                                  .height = 90,
                                                  .color_mode = ColorMode::index,
                                                  .color_bits = 8,
                                                  .depth = DepthFormat::unorm16});
}

TEST(FloatingPointModeOfTheCaller, ChangesNoBitOfTheTestScenes) {
  Renderer renderer({.threads = 1});
  for (const auto& entry : std::filesystem::directory_iterator(TESSERA_TEST_SCENES)) {
    if (entry.path().extension() != ".json") continue;
    const Scene scene = load_scene(entry.path().string());
    Fingerprint prints[2];
    for (const bool odd : {false, true}) {
      FrameBuffer buffer(scene.framebuffer);
      Frame frame(buffer);
      program::record(scene, frame);
      {
        const HostMode host(odd ? kModes[3] : kMasks);
        renderer.finish(frame);
      }
      prints[odd] = fingerprint(buffer);
    }
    EXPECT_EQ(prints[0], prints[1]) << entry.path().filename();
  }
}

TEST(FloatingPointModeOfTheCaller, ChangesNoBitOfReadDepthsPalettesAndClears) {
  const FrameBufferFormat format{
      .width = 90,
      .height = 2,
      .color_mode = ColorMode::index,
      .color_bits = 4,
      .palette = {{0.1f, 0.3f, 0.7f, 1}, {0.9f, 0.499f, 0.501f, 1}, {1.5f / 255, 2.5f / 255, 0, 1}},
      .depth = DepthFormat::unorm32};
  std::vector<float> depths[2];
  std::vector<std::uint8_t> shown[2];
  for (const bool odd : {false, true}) {
    const HostMode host(odd ? kModes[3] : kMasks);
    Renderer renderer({.threads = 1});
    FrameBuffer buffer(format);
    Frame frame(buffer);
    Random random(4);
    for (int x = 0; x < 90; ++x)
      frame.clear({.index = static_cast<std::uint32_t>(x % 3),
                   .depth = random.between(0, 1),
                   .scissor = Rect{x, 0, 1, 2}});
    renderer.finish(frame);
    depths[odd].resize(180);
    buffer.read_depth(depths[odd]);
    Image image(buffer);
    buffer.read_color(image.target());
    shown[odd] = image.bytes;
  }
  EXPECT_EQ(depths[0], depths[1]);
  EXPECT_EQ(shown[0], shown[1]);
}

// Called after every task, and slow enough to be called again after the next one.
TEST(FloatingPointModeOfTheCaller, SetByAProgressCallbackChangesNoBit) {
  const ThreadLimit limit(4);
  const FrameBufferFormat format{.width = 140, .height = 90};
  const RandomFrame random(format, 400);
  for (const int threads : {1, 4}) {
    Fingerprint prints[2];
    for (const bool odd : {false, true}) {
      Renderer renderer({.threads = threads, .tile_size = 32, .progress = [&](double) {
                           if (odd) _mm_setcsr(kModes[3]);
                           std::this_thread::sleep_for(std::chrono::milliseconds(10));
                           return true;
                         }});
      FrameBuffer buffer(format);
      Frame frame(buffer);
      record(random, frame);
      renderer.finish(frame);
      prints[odd] = fingerprint(buffer);
    }
    EXPECT_EQ(prints[0], prints[1]) << threads << " threads";
  }
}

TEST(FloatingPointModeOfTheCaller, IsRestoredIfAFrameFails) {
  Renderer renderer({.threads = 1});
  FrameBuffer buffer({.width = 8, .height = 8});
  Frame frame(buffer);
  frame.clear({.color = Color{}});
  frame.keep({});
  renderer.finish(frame);
  frame.clear({.color = Color{}, .scissor = Rect{0, 0, 4, 4}});
  bool untouched = false;
  std::optional<std::string> error;
  {
    const HostMode host(kModes[3]);
    error = error_of([&] { renderer.finish(frame); });
    untouched = host.untouched();
  }
  EXPECT_TRUE(error);
  EXPECT_TRUE(untouched);
}

}  // namespace
}  // namespace tessera::renderer_floating_point_test

#endif
