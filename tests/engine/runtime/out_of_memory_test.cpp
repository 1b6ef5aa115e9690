// Fails each allocation of a frame once: each failure is one Error, and the frame can be finished afterwards.
#include <gtest/gtest.h>

#include <malloc.h>

#include <cstdlib>
#include <new>

#include "tests/engine/frame/api_random_frame.h"
#include "tests/engine/runtime/failing_allocations.h"

#if TESSERA_CAN_FAIL_ALLOCATIONS

std::atomic<long> tessera::test::allocations_left = -1;
std::atomic<long> tessera::test::live_bytes = 0;
std::atomic<long> tessera::test::peak_live_bytes = 0;

namespace {
using tessera::test::allocations_left, tessera::test::live_bytes, tessera::test::peak_live_bytes;

void* counted(void* memory) noexcept {
  const long bytes = live_bytes += static_cast<long>(malloc_usable_size(memory));
  for (long most = peak_live_bytes; most < bytes && !peak_live_bytes.compare_exchange_weak(most, bytes);) {}
  return memory;
}
void release(void* memory) noexcept {
  live_bytes -= static_cast<long>(malloc_usable_size(memory));
  std::free(memory);
}

void* take(std::size_t size, std::size_t alignment) {
  if (allocations_left.load() >= 0 && allocations_left.fetch_sub(1) == 0) throw std::bad_alloc();
  void* const memory = std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
  if (memory == nullptr) throw std::bad_alloc();
  return counted(memory);
}
}  // namespace

void* operator new(std::size_t size) { return take(size == 0 ? 1 : size, alignof(std::max_align_t)); }
void* operator new(std::size_t size, std::align_val_t alignment) {
  return take(size == 0 ? 1 : size, static_cast<std::size_t>(alignment));
}
// std::stable_sort uses this form and continues without the memory.
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  return counted(std::malloc(size == 0 ? 1 : size));
}
void operator delete(void* memory) noexcept { release(memory); }
void operator delete(void* memory, std::size_t) noexcept { release(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { release(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { release(memory); }

namespace tessera::out_of_memory_test {
namespace {

using namespace test;

TEST(OutOfMemory, FailedFrameCanBeFinishedAfterwards) {
  const RandomFrame scene({.width = 150, .height = 90, .accumulation_bits = 16}, 60);
  // A failure after the last tile (in the log message) leaves the picture stored, so buffers that are read
  // are cleared first.
  const auto record_more = [](Frame& frame) {
    frame.clear({.stencil = 3u, .accumulation = Color{0, 0, 0, 0}});
    frame.clear({.stencil = 5u, .scissor = Rect{1, 1, 5, 5}});
    frame.accumulate({});
  };
  for (const bool stencil : {false, true}) {
    Renderer plain({.threads = 1});
    FrameBuffer reference(scene.format);
    Frame once(reference);
    scene.record(once);
    if (stencil) {
      record_more(once);
    }
    plain.finish(once);
    const Fingerprint expected = fingerprint(reference);
    std::vector<std::uint32_t> draw_ids(pixel_count(reference));
    std::vector<std::uint32_t> expected_draw_ids(draw_ids.size());
    std::vector<float> normals(3 * draw_ids.size());
    scene.record(once);
    once.capture({.draw_ids = expected_draw_ids});
    plain.finish(once);
    std::optional<Renderer> renderer;
    std::optional<FrameBuffer> buffer;
    std::optional<Frame> frame;
    const auto start = [&] {
      frame.reset();
      buffer.emplace(scene.format);
      // A new renderer without scratch memory, with a log callback.
      renderer.emplace(RendererOptions{
          .threads = 1, .debug = {.count_fragments = stencil}, .log = [](LogLevel, std::string_view) {}});
      frame.emplace(*buffer);
      scene.record(*frame);
      if (stencil) {
        record_more(*frame);
        frame->capture({.draw_ids = draw_ids, .normals = normals});
      }
    };
    start();
    const int allocations =
        fail_every_allocation([&] { renderer->finish(*frame); },
                              [&](int at) {
                                EXPECT_GT(frame->draw_count(), 0u) << "still recorded";
                                renderer->finish(*frame);
                                EXPECT_EQ(fingerprint(*buffer), expected) << "allocation " << at;
                                if (stencil) {
                                  EXPECT_EQ(draw_ids, expected_draw_ids) << "still captured";
                                }
                                start();
                              });
    EXPECT_GT(allocations, 20);
  }
}

TEST(OutOfMemory, RecordingAndReadingThrowError) {
  const RandomFrame scene({.width = 40, .height = 30}, 20);
  Renderer renderer({.threads = 1});
  FrameBuffer buffer(scene.format);
  Image image(buffer);
  const auto nothing = [](int) {};
  EXPECT_GT(fail_every_allocation([&] { FrameBuffer fresh(scene.format); }, nothing), 0);
  EXPECT_GT(fail_every_allocation([&] { Renderer fresh({.threads = 1}); }, nothing), 0);
  EXPECT_GT(fail_every_allocation(
                [&] {
                  Frame frame(buffer);
                  scene.record(frame);
                  frame.keep({Buffer::color});
                  frame.explain(0);
                },
                nothing),
            5);
  EXPECT_GT(fail_every_allocation([&] { buffer.read_color(image.target()); }, nothing), 0);
  EXPECT_GT(fail_every_allocation([&] { buffer.plane(Buffer::depth, 0); }, nothing), 0);
}

}  // namespace
}  // namespace tessera::out_of_memory_test

#endif
