// A frame equal to the previous one allocates nothing: all memory is kept between frames.
#include "tests/engine/runtime/failing_allocations.h"

#if TESSERA_CAN_FAIL_ALLOCATIONS

#include <functional>
#include <limits>
#include <memory>
#include <numeric>
#include <vector>

#include "engine/program/threads/thread_limit.h"
#include "tests/engine/frame/api_random_operations.h"
#include "tests/engine/runtime/test_executors.h"
#include "tests/engine/stages/bin_overflow_scene.h"

namespace tessera::steady_frames_test {
using namespace detail;
using namespace program;
namespace {

using namespace test;

/// Number of allocations of `act`, on any thread.
template <class Act>
long allocations_of(const Act& act) {
  constexpr long kPlenty = std::numeric_limits<long>::max() / 2;
  allocations_left = kPlenty;
  act();
  const long made = kPlenty - allocations_left;
  allocations_left = -1;
  return made;
}

/// @param before_the_last  called before the frame that must not allocate
template <class Scene>
void expect_steady(
    const Scene& scene, const RendererOptions& options, bool keeps_planes,
    const std::function<void()>& before_the_last = [] {}) {
  SCOPED_TRACE(std::to_string(options.threads) + (options.threads > 1 ? " threads" : " thread") +
               (keeps_planes ? ", planes" : ", an image"));
  Renderer renderer(options);
  FrameBuffer buffer(scene.format);
  Frame frame(buffer);
  std::vector<std::uint8_t> image(4 * pixel_count(buffer));
  const ImageTarget target{.pixels = image.data(),
                           .width = scene.format.width,
                           .height = scene.format.height,
                           .stride_bytes = 4 * scene.format.width};
  const auto draw = [&] {
    scene.record(frame);
    keeps_planes ? renderer.finish(frame) : renderer.finish(frame, target);
  };
  EXPECT_GT(allocations_of(draw), 10) << "allocations of the first frame are counted";
  draw();
  before_the_last();
  EXPECT_EQ(allocations_of(draw), 0);
}

/// Everything that is built during a frame: strip corners, generated normals, clipped outlines, palette
/// entries; with a moving camera.
struct MadeOnTheWay {
  FrameBufferFormat format{.width = 300, .height = 200, .color_mode = ColorMode::index, .color_bits = 8};
  std::vector<MeshData> meshes;
  std::vector<Light> lights{3};
  MadeOnTheWay() {
    for (const Primitive primitive :
         {Primitive::triangle_strip, Primitive::quads, Primitive::polygon, Primitive::line_loop}) {
      MeshData& mesh = meshes.emplace_back();
      mesh.primitive = primitive;
      Random random(17);
      for (int i = 0; i < 3 * 4 * 500; ++i) mesh.positions.push_back(random.between(-1.3f, 1.3f));
    }
  }
  void record(Frame& frame) const {
    frame.clear({.index = 3, .depth = 1.0});
    for (const MeshData& mesh : meshes)
      for (const Shading shading : {Shading::flat, Shading::gouraud, Shading::phong}) {
        frame.set_camera({.view = rotate(20.0 * static_cast<int>(shading), 0, 1, 0)});
        frame.set_lights(std::span(lights).first(1 + static_cast<std::size_t>(shading)));
        DrawState state;
        state.shading = shading;
        state.back_mode = PolygonMode::line;
        frame.draw(mesh.view(), state);
      }
  }
};

/// Small meshes whose normals any worker may generate, and draws in between that change nothing.
struct ManySmallMeshes {
  FrameBufferFormat format{.width = 300, .height = 200};
  std::vector<MeshData> meshes;
  ManySmallMeshes() {
    Random random(23);
    for (int i = 0; i < 60; ++i)
      for (int v = 0; v < 3 * 3 * (1 + 40 * (i % 30)); ++v)
        (v == 0 ? meshes.emplace_back() : meshes.back()).positions.push_back(random.between(-0.9f, 0.9f));
  }
  void record(Frame& frame) const {
    frame.clear({.color = Color{0, 0, 0, 1}, .depth = 1.0});
    for (std::size_t i = 0; i < meshes.size(); ++i) {
      DrawState state;
      state.color_mask.fill(i % 7 != 0);
      state.depth.enabled = i % 7 != 0;
      frame.draw(meshes[i].view(), state);
    }
  }
};

TEST(SteadyFrames, AllocateNothing) {
  const ThreadLimit limit(2);
  for (const bool keeps_planes : {false, true}) {
    for (const int threads : {1, 2}) expect_steady(MadeOnTheWay(), {.threads = threads}, keeps_planes);
    expect_steady(BinOverflowScene({.width = 300, .height = 200}), {.threads = 2}, keeps_planes);
    expect_steady(BinOverflowScene({.width = 300, .height = 200}), {.threads = 1}, keeps_planes);
    expect_steady(RandomOperations({.width = 300, .height = 200, .alpha_bits = 8}), {.threads = 1},
                  keeps_planes);
    expect_steady(RandomOperations({.width = 300, .height = 200, .samples = 4}), {.threads = 1},
                  keeps_planes);
  }
}

TEST(SteadyFrames, AllocateNothingOnAnyWorker) {
  for (const bool keeps_planes : {false, true}) {
    const auto executor = std::make_shared<SingleThreadExecutor>(2);
    expect_steady(ManySmallMeshes(), {.threads = 2, .executor = executor}, keeps_planes,
                  [&] { executor->begin_with(1); });
  }
}

}  // namespace
}  // namespace tessera::steady_frames_test

#endif
