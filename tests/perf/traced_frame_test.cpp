// What is made of a frame's tasks: a trace for viewers, and a picture of what tiles cost.
#include "perf/bench/traced_frame.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "perf/bench/bench_meshes.h"
#include "perf/bench/drawn_workload.h"

namespace tessera::bench {
namespace {

using Json = nlohmann::json;

// Two tiles above one of both's width; the lower one costs 1 ns a pixel, the upper ones 3 and 2.
TracedFrame three_tiles() {
  TracedFrame frame{.workload = "made up", .seconds = 1e-6};
  frame.tasks = {{.stage = FrameStage::vertices, .worker = 1, .begin = 0, .end = 1e-4},
                 {.stage = FrameStage::tiles, .worker = 0, .begin = 2e-4, .end = 2e-4 + 8e-9, .pixels = {0, 0, 4, 2}, .pass = 1},
                 {.stage = FrameStage::tiles, .worker = 1, .begin = 3e-4, .end = 3e-4 + 12e-9, .pixels = {0, 2, 2, 2}, .pass = 1},
                 {.stage = FrameStage::tiles, .worker = 0, .begin = 4e-4, .end = 4e-4 + 8e-9, .pixels = {2, 2, 2, 2}, .pass = 1}};
  return frame;
}

TEST(TracedFrame, AddsUpItsTasks) { EXPECT_NEAR(three_tiles().seconds_in_tasks(), 1e-4 + 28e-9, 1e-15); }

WorkloadEntry grid_of(int columns, int draws = 1) {
  return drawn("grid", "", [columns, draws](int, int, std::uint32_t) {
    Drawing drawing{.format = {.width = 256, .height = 256}};
    drawing.meshes.push_back(window_grid(columns, 64));
    drawing.record = [draws](const Drawing& d, Frame& frame) {
      frame.clear({.color = Color{0, 0, 0, 1}, .depth = 1.0});
      for (int i = 0; i < draws; ++i) frame.draw(d.meshes.front().view(), {.lighting = false});
    };
    return drawing;
  });
}

// What one worker does between its tasks is neither theirs nor the frame's own.
TEST(TracedFrame, MeasuresTasksTheirTakingAndTheRestApart) {
  const WorkloadEntry grid = grid_of(64);
  for (const int workers : {1, 2, 64}) {
    const TracedFrame frame = cost_of_frame(grid, {.width = 256, .height = 256, .options = {.tile_size = 32}}, workers);
    EXPECT_GT(frame.tasks.size(), 64u) << workers;
    EXPECT_GT(frame.seconds_taking, 0) << workers;
    EXPECT_GT(frame.seconds, frame.seconds_taking + frame.seconds_in_tasks()) << workers;
    const TracedFrame tasks = cost_of_tasks(grid, {.width = 256, .height = 256, .options = {.tile_size = 32}}, workers);
    EXPECT_DOUBLE_EQ(tasks.seconds, tasks.seconds_taking + tasks.seconds_in_tasks()) << workers;
  }
}

TEST(TracedFrame, CountsCallsForWorkersThatNoTaskTellsOf) {
  EXPECT_EQ(cost_of_frame(grid_of(64), {.options = {.tile_size = 32}}, 2).calls_without_tasks, 0);
  EXPECT_EQ(cost_of_frame(grid_of(256), {.options = {.tile_size = 32}}, 2).calls_without_tasks, 1) << "so many indices that recording asks for help";
  EXPECT_EQ(cost_of_frame(grid_of(4, 17), {.options = {.tile_size = 32}}, 2).calls_without_tasks, 1) << "so many draws that planning does";
}

TEST(TracedFrame, IsAChromeTrace) {
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

TEST(TracedFrame, IsAPictureOfWhatItsTilesCost) {
  const Heatmap map = heatmap(three_tiles());
  EXPECT_NEAR(map.most_ns_a_pixel, 3, 1e-6);
  const auto pixel = [&](int x, int y) {  // from the top
    const std::uint8_t* p = map.picture.rgba.data() + 4 * (4 * y + x);
    return std::vector<int>(p, p + 4);
  };
  for (const int y : {0, 1}) {
    EXPECT_EQ(pixel(0, y), (std::vector{255, 255, 255, 255})) << "the dearest is white";
    EXPECT_EQ(pixel(2, y), (std::vector{255, 255, 0, 255})) << "two thirds of it: yellow";
  }
  for (const int x : {0, 1, 2, 3}) EXPECT_EQ(pixel(x, 3), (std::vector{255, 0, 0, 255})) << "a third of it: red";
}

TEST(TracedFrame, WithoutTilesIsNoPicture) {
  TracedFrame frame = three_tiles();
  frame.tasks.resize(1);
  const Heatmap map = heatmap(frame);
  EXPECT_EQ(map.most_ns_a_pixel, 0);
  EXPECT_TRUE(map.picture.rgba.empty());
}

}  // namespace
}  // namespace tessera::bench
