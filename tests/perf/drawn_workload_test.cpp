// Checks that workloads apply to their pictures: frames that draw too little are faults.
#include "perf/bench/drawn_workload.h"

#include <gtest/gtest.h>

#include "perf/bench/bench_meshes.h"

namespace tessera::bench::drawn_workload_test {
namespace {

constexpr int kSide = 16;

/// A depth-only layer, drawn or left out, that `reveal` shows in white.
Drawing depth_only(bool is_drawn) {
  Drawing drawing{.format = {.width = kSide, .height = kSide}};
  drawing.meshes.push_back(window_grid(1, 1));
  drawing.meshes.back().colors.clear();
  drawing.record = [is_drawn](const Drawing& d, Frame& frame) {
    frame.clear({.color = Color{0, 0, 0, 1}, .depth = 1.0});
    if (is_drawn)
      frame.draw(d.meshes.front().view(), {.lighting = false, .color_mask = {false, false, false, false}});
  };
  drawing.reveal = [](const Drawing& d, Frame& frame) {
    frame.draw(d.meshes.front().view(),
               {.material = {.diffuse = {1, 1, 1, 1}}, .lighting = false, .depth = {.test = Compare::equal}});
  };
  drawing.fragments = kSide * kSide;
  return drawing;
}

std::unique_ptr<Workload> workload_of(const std::function<Drawing()>& make) {
  return drawn("drawn", "", [make](int, int, std::uint32_t) { return make(); })
      .make({.width = kSide, .height = kSide, .options = {.threads = 1}});
}

TEST(BenchDrawnWorkload, RevealsDepthInCheckedFramesOnly) {
  const auto workload = workload_of([] { return depth_only(true); });
  EXPECT_EQ(workload->fault(), "");
  EXPECT_EQ(workload->picture().rgba[0], 255);
  EXPECT_EQ(workload->draw().shaded_pixels, 0u) << "timed frames";
  EXPECT_EQ(workload->picture().rgba[0], 0);
}

TEST(BenchDrawnWorkload, ReportsMissingFragments) {
  EXPECT_EQ(workload_of([] { return depth_only(false); })->fault(), "shaded 0 pixels, expected 256");
}

TEST(BenchDrawnWorkload, LimitsTileBytesToTheFrame) {
  for (const int tile_size : {32, 64}) {
    const auto fill = drawn("fill", "", [](int, int, std::uint32_t) {
      Drawing drawing = depth_only(true);
      drawing.format = {.width = 48, .height = 200};
      drawing.pixel_bytes = 8;
      return drawing;
    });
    const auto workload = fill.make({.options = {.threads = 1, .tile_size = tile_size}});
    const FrameWork work = workload->work(workload->draw());
    EXPECT_EQ(work.tile_bytes, tile_size == 32 ? 8u * 32 * 32 : 8u * 48 * 64) << tile_size;
  }
}

TEST(BenchDrawnWorkload, ReportsFaultOfThePicture) {
  const auto white = [] {
    Drawing drawing = depth_only(true);
    drawing.fault = [](const Picture& picture) { return picture.rgba[0] == 255 ? "too white" : ""; };
    return drawing;
  };
  EXPECT_EQ(workload_of(white)->fault(), "too white");
}

}  // namespace
}  // namespace tessera::bench::drawn_workload_test
