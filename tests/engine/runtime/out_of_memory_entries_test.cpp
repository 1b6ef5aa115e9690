// Fails each allocation of every public function once: the result is an Error that names memory, the state
// before the call is kept, and later calls succeed. Covers frames of every kind of draw, on one thread and on
// two.
#include "tests/engine/runtime/failing_allocations.h"

#if TESSERA_CAN_FAIL_ALLOCATIONS

#include <algorithm>
#include <functional>
#include <memory>
#include <optional>

#include "engine/program/threads/thread_limit.h"
#include "tests/engine/frame/api_random_operations.h"
#include "tests/engine/stages/bin_overflow_scene.h"
#include "tests/raster/random_triangles.h"

namespace tessera::out_of_memory_entries_test {
using namespace detail;
using namespace program;
namespace {

using namespace test;

std::vector<FrameBufferFormat> formats() {
  const FrameBufferFormat base{.width = 40, .height = 34, .accumulation_bits = 16};
  std::vector<FrameBufferFormat> all(4, base);
  all[1].samples = 4;
  all[1].depth = DepthFormat::float32;
  all[1].alpha_bits = 8;
  all[1].accumulation_bits = 32;
  all[2].color_mode = ColorMode::index;
  all[2].color_bits = 4;
  all[2].dither = Dither::bayer2;
  all[2].accumulation_bits = 0;
  // Building the search structure of a large palette would make thousands of allocations.
  all[2].palette = {{0, 0, 0, 1}, {0.3f, 0.7f, 0.1f, 1}, {1, 1, 1, 1}};
  all[3].color_bits = 2;
  all[3].depth = DepthFormat::none;
  all[3].stencil_bits = 0;
  return all;
}

// Points, lines, polygons in each mode, textures, shadows, bitmaps, images, index lighting, accumulation. The
// frame begins with clears, also of the accumulation buffer, so that it can be finished after a failure.
template <class Scene>
void record(const Scene& scene, Frame& frame) {
  if (scene.format.accumulation_bits > 0) frame.clear({.accumulation = Color{0, 0, 0, 0}});
  scene.record(frame);
}

// Returns the number of allocations.
template <class Scene>
int expect_that_it_can_be_finished_afterwards(const Scene& scene, const RendererOptions& options) {
  SCOPED_TRACE(describe(scene.format) + ", " + std::to_string(options.threads) +
               (options.threads > 1 ? " threads" : " thread"));
  FrameBuffer plain(scene.format);
  Frame once(plain);
  record(scene, once);
  Renderer({.threads = 1}).finish(once);
  const Fingerprint expected = fingerprint(plain);
  std::optional<Renderer> renderer;
  std::optional<FrameBuffer> buffer;
  std::optional<Frame> frame;
  const auto start = [&] {
    frame.reset();
    buffer.emplace(scene.format);
    renderer.emplace(options);
    frame.emplace(*buffer);
    record(scene, *frame);
  };
  start();
  const std::size_t draws = frame->draw_count();
  return fail_every_allocation([&] { renderer->finish(*frame); },
                               [&](int at) {
                                 EXPECT_EQ(frame->draw_count(), draws) << "still recorded";
                                 // The same renderer and buffer; sometimes with another frame in between.
                                 if (at % 5 == 0) {
                                   FrameBuffer other({.width = 20, .height = 20});
                                   Frame small(other);
                                   small.clear({.color = Color{1, 1, 1, 1}});
                                   renderer->finish(small);
                                   EXPECT_EQ(packed_colors(other)[7], 0xffffffu);
                                 }
                                 renderer->finish(*frame);
                                 EXPECT_EQ(fingerprint(*buffer), expected) << "allocation " << at;
                                 start();
                               });
}

void expect_frames_that_can_be_finished_afterwards(int threads, int draws) {
  const ThreadLimit limit(std::max(threads, 2));
  for (const FrameBufferFormat& format : formats()) {
    const RandomOperations scene(format, format.samples == 1 && format.color_bits == 24 ? draws : draws / 2);
    EXPECT_GT(expect_that_it_can_be_finished_afterwards(scene, {.threads = threads, .tile_size = 32}), 60);
    if (testing::Test::HasFailure()) return;
  }
}

// Enough draws for each of the ten primitives.
TEST(OutOfMemoryAnywhere, FramesOfEveryKindCanBeFinishedAfterwards) {
  expect_frames_that_can_be_finished_afterwards(1, long_tests() ? 40 : 21);
}
TEST(OutOfMemoryAnywhere, FramesOnTwoThreadsCanBeFinishedAfterwards) {
  expect_frames_that_can_be_finished_afterwards(2, long_tests() ? 40 : 5);
}

TEST(OutOfMemoryAnywhere, FramesInPartsOfFewTilesCanBeFinishedAfterwards) {
  const BinOverflowScene scene({.width = 120, .height = 60}, 510);
  const RendererOptions options{.threads = 1, .tile_size = 32, .bin_memory = kMinBinMemory};
  FrameBuffer buffer(scene.format);
  Frame frame(buffer);
  scene.record(frame);
  ASSERT_GT(Renderer(options).finish(frame).bin_passes, 1u);
  EXPECT_GT(expect_that_it_can_be_finished_afterwards(scene, options), 200);
}
TEST(OutOfMemoryAnywhere, FramesInPartsOfFewBatchesCanBeFinishedAfterwards) {
  EXPECT_GT(
      expect_that_it_can_be_finished_afterwards(BinOverflowScene({.width = 60, .height = 50}, 2502),
                                                {.threads = 1, .tile_size = 64, .bin_memory = kMinBinMemory}),
      100);
}

// Draws recorded before the failed call remain; nothing of the failed call does.
TEST(OutOfMemoryAnywhere, FailedRecordingLeavesTheFrameUnchanged) {
  const FrameBufferFormat format{.width = 40, .height = 30, .accumulation_bits = 16};
  const std::vector<std::uint8_t> bytes(4 * 8 * 8, 0x7e);
  const Texture texture({.pixels = bytes.data(), .width = 8, .height = 8});
  const MeshData mesh = rectangle(-0.5f, -0.5f, 0.6f, 0.4f);
  std::vector<Light> lights(3);
  lights[1].position = {0, 0, 5, 1};
  DrawState red = unlit({1, 0, 0, 1});
  DrawState shadow;
  DrawState textured;
  shadow.shadow_on = ShadowOn{.plane = {0, 0, 1, 2}};
  textured.texture = &texture;
  const auto begin = [&](Frame& frame) {
    frame.clear({.color = Color{0.2f, 0.3f, 0.4f, 1}, .accumulation = Color{0.5f, 0, 0, 0}});
    frame.draw(mesh.view(), red);
    frame.keep({Buffer::color, Buffer::depth, Buffer::stencil, Buffer::accumulation});
  };
  const auto finish = [](Frame& frame) { Renderer({.threads = 1}).finish(frame); };
  FrameBuffer plain(format);
  Frame before(plain);
  begin(before);
  finish(before);
  const Fingerprint expected = fingerprint(plain);
  struct Call {
    const char* name;
    std::function<void(Frame&)> run;
  };
  const std::vector<Call> calls{
      {"set_camera", [](Frame& f) { f.set_camera({.projection = perspective(50, 1, 1, 5)}); }},
      {"set_lights", [&](Frame& f) { f.set_lights(lights); }},
      {"set_light_model", [](Frame& f) { f.set_light_model({.two_sided = true}); }},
      {"set_quality", [](Frame& f) { f.set_quality({.viewer = ViewerCap::infinite}); }},
      {"clear",
       [](Frame& f) {
         f.clear({.color = Color{1, 1, 1, 1}});
       }},
      {"accumulate", [](Frame& f) { f.accumulate({.op = AccumOp::return_color}); }},
      {"draw", [&](Frame& f) { f.draw(mesh.view(), {}); }},
      {"draw a shadow", [&](Frame& f) { f.draw(mesh.view(), shadow); }},
      {"draw textured", [&](Frame& f) { f.draw(mesh.view(), textured); }},
      {"draw_bitmap", [&](Frame& f) { f.draw_bitmap({.bits = bytes.data(), .width = 8, .height = 8}); }},
      {"draw_image", [&](Frame& f) { f.draw_image({.pixels = bytes.data(), .width = 8, .height = 8}); }},
      {"explain", [](Frame& f) { (void)f.explain(0); }}};
  for (const Call& call : calls) {
    SCOPED_TRACE(call.name);
    std::optional<FrameBuffer> buffer;
    std::optional<Frame> frame;
    const auto start = [&] {
      frame.reset();
      buffer.emplace(format);
      frame.emplace(*buffer);
      begin(*frame);
    };
    start();
    EXPECT_GT(fail_every_allocation([&] { call.run(*frame); },
                                    [&](int) {
                                      EXPECT_EQ(frame->draw_count(), 1u);
                                      // The state for later draws is unchanged too.
                                      finish(*frame);
                                      EXPECT_EQ(fingerprint(*buffer), expected);
                                      start();
                                    }),
              0);
  }
}

TEST(OutOfMemoryAnywhere, ConstructionAndReadingLeaveObjectsUnchanged) {
  const FrameBufferFormat format{.width = 40,
                                 .height = 30,
                                 .color_mode = ColorMode::index,
                                 .color_bits = 8,
                                 .palette = {{0, 0, 0, 1}, {1, 0, 0, 1}, {0, 1, 0, 1}}};
  const FrameBufferFormat rgb{
      .width = 40, .height = 30, .alpha_bits = 8, .accumulation_bits = 16, .samples = 4};
  const std::vector<std::uint8_t> bytes(4 * 17 * 13, 0x35);
  const std::vector<Color> other{{0.5f, 0.5f, 0, 1}, {0, 0, 1, 1}};
  FrameBuffer indices(format);
  FrameBuffer colors(rgb);
  const MeshData mesh = rectangle(-0.5f, -0.5f, 0.6f, 0.4f);
  for (FrameBuffer* const buffer : {&indices, &colors}) {
    Frame frame(*buffer);
    frame.clear({.color = Color{0, 1, 0, 1}, .depth = 0.9, .stencil = 3});
    frame.draw(mesh.view(), unlit({1, 0, 0, 1}));
    Renderer({.threads = 1}).finish(frame);
  }
  Image image(indices);
  Image before(indices);
  indices.read_color(before.target());
  const auto shows_the_same = [&](int at) {
    indices.read_color(image.target());
    EXPECT_TRUE(image.bytes == before.bytes) << "allocation " << at;
  };
  const auto nothing = [](int) {};
  std::vector<std::uint32_t> words(1200);
  std::vector<float> floats(4800);
  std::vector<float> depths(1200);
  std::vector<std::uint8_t> stencil(1200);
  std::vector<std::byte> room(FrameBuffer::memory_bytes(rgb) + 64);
  std::byte* const aligned = room.data() + (64 - reinterpret_cast<std::uintptr_t>(room.data()) % 64) % 64;
  const TextureSampler mipmaps;
  const TextureSampler plain{.min = TextureFilter::linear};
  // Passed by move: copying the palette would be an allocation of the caller.
  std::vector<FrameBufferFormat> copies(200, format);
  const std::pair<const char*, std::function<void()>> calls[] = {
      {"FrameBuffer of indices",
       [&] {
         FrameBufferFormat copy = std::move(copies.back());
         copies.pop_back();
         FrameBuffer fresh(std::move(copy));
       }},
      {"FrameBuffer of colours", [&] { FrameBuffer fresh(rgb); }},
      {"FrameBuffer in lent memory",
       [&] {
         FrameBuffer fresh(rgb, {aligned, FrameBuffer::memory_bytes(rgb)});
       }},
      {"Texture with mipmaps",
       [&] { Texture fresh({.pixels = bytes.data(), .width = 17, .height = 13}, mipmaps); }},
      {"Texture without", [&] { Texture fresh({.pixels = bytes.data(), .width = 17, .height = 13}, plain); }},
      {"Renderer", [&] { Renderer fresh({.threads = 1, .log = [](LogLevel, std::string_view) {}}); }},
      {"Renderer of two threads", [&] { Renderer fresh({.threads = 2}); }},
      {"Frame", [&] { Frame fresh(colors); }},
      {"named_palette", [] { (void)named_palette("vga256", 8); }},
      {"default_palette", [] { (void)default_palette(4); }},
      {"read_color", [&] { indices.read_color(image.target()); }},
      {"read_packed_colors", [&] { indices.read_packed_colors(words); }},
      {"read_depth", [&] { colors.read_depth(depths); }},
      {"read_stored_depths", [&] { colors.read_stored_depths(words); }},
      {"read_view_depth", [&] { colors.read_view_depth(depths, {}); }},
      {"read_stencil", [&] { colors.read_stencil(stencil); }},
      {"read_accumulation", [&] { colors.read_accumulation(floats); }},
  };
  for (const auto& [name, call] : calls) {
    SCOPED_TRACE(name);
    EXPECT_GT(fail_every_allocation(call, nothing), 0);
    shows_the_same(-1);
  }
  // On failure a new buffer keeps its cleared contents, and a buffer shows its old palette.
  const Fingerprint of_colors = fingerprint(colors);
  for (const Buffer which : {Buffer::color, Buffer::depth, Buffer::stencil, Buffer::accumulation}) {
    FrameBuffer fresh(rgb);
    EXPECT_GT(fail_every_allocation([&] { fresh.plane(which, 0); }, nothing), 0);
    EXPECT_EQ(fresh.plane(which, 0).bits[0], which == Buffer::depth ? 0xff : 0);
  }
  EXPECT_EQ(fingerprint(colors), of_colors);
  EXPECT_GT(fail_every_allocation([&] { indices.set_palette(other); }, shows_the_same), 0);
  indices.read_color(image.target());
  EXPECT_FALSE(image.bytes == before.bytes) << "the new palette is shown after success";
  EXPECT_EQ(indices.format().palette.size(), 2u);
}

}  // namespace
}  // namespace tessera::out_of_memory_entries_test

#endif
