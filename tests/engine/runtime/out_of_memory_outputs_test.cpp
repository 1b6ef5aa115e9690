// Fails each allocation in turn, in frames with an ImageTarget, captures and a trace, of new renderers and of
// renderers that must grow: pictures and captures are correct in the end. A trace may lose an allocation
// silently, because no result depends on it.
#include "tests/engine/runtime/failing_allocations.h"

#if TESSERA_CAN_FAIL_ALLOCATIONS

#include <algorithm>
#include <optional>
#include <vector>

#include "engine/program/threads/thread_limit.h"
#include "tests/engine/frame/api_random_frame.h"
#include "tests/engine/frame/api_random_operations.h"

namespace tessera::out_of_memory_outputs_test {
using namespace detail;
using namespace program;
namespace {

using namespace test;

/// The caller's memory for all outputs of a frame.
struct Outputs {
  Image image;
  std::vector<std::uint32_t> draw_ids;
  std::vector<std::uint32_t> primitive_ids;
  std::vector<float> normals;

  explicit Outputs(const FrameBuffer& buffer)
      : image(buffer),
        draw_ids(pixel_count(buffer)),
        primitive_ids(draw_ids.size()),
        normals(3 * draw_ids.size()) {
    forget();
  }
  void forget() {
    std::fill(image.bytes.begin(), image.bytes.end(), std::uint8_t{0xcd});
    std::fill(draw_ids.begin(), draw_ids.end(), 7u),
        std::fill(primitive_ids.begin(), primitive_ids.end(), 7u),
        std::fill(normals.begin(), normals.end(), 7.0f);
  }
  Capture capture() { return {.draw_ids = draw_ids, .primitive_ids = primitive_ids, .normals = normals}; }
};
void expect_same(const Outputs& found, const Outputs& expected, int at) {
  EXPECT_TRUE(found.image.bytes == expected.image.bytes) << "picture, allocation " << at;
  EXPECT_TRUE(found.draw_ids == expected.draw_ids && found.primitive_ids == expected.primitive_ids &&
              found.normals == expected.normals)
      << "captures, allocation " << at;
}

struct Wanted {
  bool captures = false;
  bool trace = false;
};

// Returns the number of allocations. `before`, if not null, is a scene that the renderer has finished
// already.
template <class Scene>
int expect_outputs_afterwards(const Scene& scene, const Scene* before, const Wanted& wanted,
                              RendererOptions options) {
  SCOPED_TRACE(std::string(before ? "used" : "new") + (wanted.captures ? ", captures" : "") +
               (wanted.trace ? ", trace" : "") + ", threads: " + std::to_string(options.threads));
  std::optional<FrameBuffer> buffer(scene.format);
  std::optional<Renderer> renderer;
  std::optional<Frame> frame;
  Outputs expected(*buffer);
  Outputs found(*buffer);
  const auto record = [&](Outputs& outputs) {
    frame.emplace(*buffer);
    if (scene.format.accumulation_bits > 0) frame->clear({.accumulation = Color{0, 0, 0, 0}});
    scene.record(*frame);
    if (wanted.captures) frame->capture(outputs.capture());
  };
  record(expected);
  Renderer({.threads = 1}).finish(*frame, expected.image.target());
  std::size_t traced = 0;
  if (wanted.trace) options.trace = [&](std::span<const FrameTask> tasks) { traced = tasks.size(); };
  const auto start = [&] {
    frame.reset();
    buffer.emplace(scene.format);
    renderer.emplace(options);
    if (before) {
      FrameBuffer other(before->format);
      Image image(other);
      Frame small(other);
      before->record(small);
      renderer->finish(small, image.target());
    }
    record(found);
    found.forget();
    traced = 0;
  };
  start();
  return fail_every_allocation([&] { renderer->finish(*frame, found.image.target()); },
                               [&](int at) {
                                 found.forget();
                                 renderer->finish(*frame, found.image.target());
                                 expect_same(found, expected, at);
                                 EXPECT_EQ(traced > 0, wanted.trace);
                                 start();
                               },
                               [&](int at) {
                                 EXPECT_TRUE(wanted.trace && traced == 0)
                                     << "allocation " << at << " was ignored";
                                 expect_same(found, expected, at);
                                 start();
                               });
}

constexpr Wanted kWanted[] = {{}, {.captures = true}, {.trace = true}, {.captures = true, .trace = true}};

// In a picture that starts from a clear and stores nothing, tiles without triangles are copied from a
// prepared row.
TEST(OutOfMemoryOutputs, NewRenderersProduceAllOutputs) {
  const RandomFrame scene({.width = 150, .height = 90}, 60);
  for (const Wanted& wanted : kWanted)
    EXPECT_GT(expect_outputs_afterwards<RandomFrame>(scene, nullptr, wanted, {.threads = 1, .tile_size = 32}),
              20);
}

// Every buffer must grow again: more draws, more pixels, larger tiles, samples.
TEST(OutOfMemoryOutputs, GrowingRenderersProduceAllOutputs) {
  const RandomFrame small({.width = 20, .height = 20}, 3);
  const RandomFrame large({.width = 300, .height = 90}, 400);
  for (const Wanted& wanted : kWanted)
    EXPECT_GT(expect_outputs_afterwards(large, &small, wanted, {.threads = 1}), 10);
}
TEST(OutOfMemoryOutputs, GrowingRenderersProduceAllOutputsOfOperations) {
  const ThreadLimit limit(2);
  const RandomOperations small({.width = 20, .height = 20}, 1);
  const RandomOperations accumulated({.width = 40, .height = 34, .alpha_bits = 8, .accumulation_bits = 16},
                                     9);
  const RandomOperations sampled({.width = 40, .height = 34, .samples = 4}, 9);
  for (const RandomOperations* const large : {&accumulated, &sampled})
    for (const int threads : {1, 2})
      EXPECT_GT(expect_outputs_afterwards(*large, &small, {.captures = true},
                                          {.threads = threads, .tile_size = 32}),
                20);
}

}  // namespace
}  // namespace tessera::out_of_memory_outputs_test

#endif
