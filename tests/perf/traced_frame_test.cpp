// Output made from the tasks of a frame: Chrome trace and heatmap.
#include "perf/bench/traced_frame.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace tessera::bench::traced_frame_test {
namespace {

using Json = nlohmann::json;

// One tile of 4x2 pixels at the bottom, 1 ns per pixel; two of 2x2 above it, 3 and 2 ns per pixel.
TracedFrame three_tiles() {
  TracedFrame frame{.workload = "made up", .seconds = 1e-6};
  frame.tasks = {{.stage = FrameStage::vertices, .worker = 1, .begin = 0, .end = 1e-4},
                 {.stage = FrameStage::tiles,
                  .worker = 0,
                  .begin = 2e-4,
                  .end = 2e-4 + 8e-9,
                  .pixels = {0, 0, 4, 2},
                  .pass = 1},
                 {.stage = FrameStage::tiles,
                  .worker = 1,
                  .begin = 3e-4,
                  .end = 3e-4 + 12e-9,
                  .pixels = {0, 2, 2, 2},
                  .pass = 1},
                 {.stage = FrameStage::tiles,
                  .worker = 0,
                  .begin = 4e-4,
                  .end = 4e-4 + 8e-9,
                  .pixels = {2, 2, 2, 2},
                  .pass = 1}};
  return frame;
}

TEST(BenchTracedFrame, AddsUpItsTasks) { EXPECT_NEAR(three_tiles().task_seconds(), 1e-4 + 28e-9, 1e-15); }

TEST(BenchTracedFrame, WritesChromeTrace) {
  TracedFrame other = three_tiles();
  other.workload = "other \"one\"";
  const Json events = Json::parse(chrome_trace({three_tiles(), other}))["traceEvents"];
  ASSERT_EQ(events.size(), 2u * (1 + 2 + 4));
  EXPECT_EQ(events[0]["ph"], "M");
  EXPECT_EQ(events[0]["args"]["name"], "made up");
  for (const int worker : {0, 1}) {
    const Json& named = events[static_cast<std::size_t>(1 + worker)];
    EXPECT_EQ(named["name"], "thread_name");
    EXPECT_EQ(named["ph"], "M");
    EXPECT_EQ(named["tid"], worker);
    EXPECT_EQ(named["args"]["name"], "worker " + std::to_string(worker));
  }
  EXPECT_EQ(events[7]["args"]["name"], "other \"one\"");
  EXPECT_EQ(events[8]["pid"], events[7]["pid"]);
  EXPECT_NE(events[8]["pid"], events[1]["pid"]);
  EXPECT_EQ(events[3]["name"], "vertices");
  EXPECT_EQ(events[3]["ph"], "X");
  EXPECT_EQ(events[3]["tid"], 1);
  EXPECT_DOUBLE_EQ(events[3]["dur"], 100) << "microseconds";
  EXPECT_EQ(events[3]["args"], Json({{"pass", 0}}));
  EXPECT_DOUBLE_EQ(events[6]["ts"], 400);
  EXPECT_EQ(events[6]["args"]["x"], 2);
  EXPECT_EQ(events[6]["args"]["height"], 2);
  EXPECT_EQ(events[6]["args"]["pass"], 1);
}

TEST(BenchTracedFrame, PaintsTileCosts) {
  const Heatmap map = heatmap(three_tiles());
  EXPECT_NEAR(map.max_ns_per_pixel, 3, 1e-6);
  const auto pixel = [&](int x, int y) {  // from the top
    const std::uint8_t* p = map.picture.rgba.data() + 4 * (4 * y + x);
    return std::vector<int>(p, p + 4);
  };
  for (const int y : {0, 1}) {
    EXPECT_EQ(pixel(0, y), (std::vector{255, 255, 255, 255})) << "most expensive tile: white";
    EXPECT_EQ(pixel(2, y), (std::vector{255, 255, 0, 255})) << "two thirds of the maximum: yellow";
  }
  for (const int x : {0, 1, 2, 3})
    EXPECT_EQ(pixel(x, 3), (std::vector{255, 0, 0, 255})) << "one third of the maximum: red";
}

TEST(BenchTracedFrame, WithoutTilesGivesEmptyHeatmap) {
  TracedFrame frame = three_tiles();
  frame.tasks.resize(1);
  const Heatmap map = heatmap(frame);
  EXPECT_EQ(map.max_ns_per_pixel, 0);
  EXPECT_TRUE(map.picture.rgba.empty());
}

}  // namespace
}  // namespace tessera::bench::traced_frame_test
