// Workloads of many small draws, small frames, textured meshes and user stages.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "perf/bench/mesh_workloads.h"
#include "perf/rivals/literal_shaders.h"

namespace tessera::bench::stage_workloads_test {
namespace {

constexpr int kWidth = 160, kHeight = 90;
const WorkloadSetup kSetup{.width = kWidth, .height = kHeight, .options = {.threads = 1}};

TEST(BenchStages, HaveThePictureOfTheirBaseline) {
  const std::vector<WorkloadEntry> entries = stage_workloads();
  EXPECT_EQ(entries.size(), 3u);
  for (const WorkloadEntry& entry : entries) {
    const WorkloadEntry* const baseline = find_workload(entry.baseline);
    ASSERT_NE(baseline, nullptr) << entry.name;
    EXPECT_EQ(entry.name, "stage-" + baseline->name);
    EXPECT_FALSE(entry.is_in_mean);
    EXPECT_FALSE(entry.gl_workload(kSetup).has_value()) << entry.name;
    const std::unique_ptr<Workload> with = entry.make(kSetup);
    const std::unique_ptr<Workload> without = baseline->make(kSetup);
    EXPECT_EQ(with->fault(), "") << entry.name;
    EXPECT_EQ(without->fault(), "") << entry.name;
    const Picture& a = with->picture();
    const Picture& b = without->picture();
    int difference = 0;  // colours may be interpolated in levels without a stage
    for (std::size_t i = 0; i < a.rgba.size(); ++i)
      difference = std::max(difference, std::abs(a.rgba[i] - b.rgba[i]));
    EXPECT_LE(difference, 1) << entry.name;
    const FrameWork staged = with->work(with->draw());
    const FrameWork plain = without->work(without->draw());
    EXPECT_EQ(staged.fragments, plain.fragments) << entry.name;
    EXPECT_EQ(staged.vertices, plain.vertices) << entry.name;
  }
}

TEST(BenchObjects, DrawEachObjectOnce) {
  for (const auto& [name, count] : {std::pair("objects-1000", 1000u), {"objects-10000", 10000u}}) {
    const WorkloadEntry* const entry = find_workload(name);
    ASSERT_NE(entry, nullptr);
    const std::unique_ptr<Workload> workload =
        entry->make({.width = 640, .height = 360, .options = {.threads = 1}});
    EXPECT_EQ(workload->fault(), "") << name;
    EXPECT_EQ(workload->work(workload->draw()).triangles, 32 * count);
    const std::optional<GlWorkload> gl = entry->gl_workload(kSetup);
    ASSERT_TRUE(gl.has_value());
    EXPECT_EQ(gl->draws.size(), count);
    EXPECT_NE(gl->draws[0].clip_from_object.m, gl->draws[1].clip_from_object.m);
    EXPECT_NE(gl->draws[0].color.r, gl->draws[1].color.r);
    EXPECT_NE(gl->shaders.vertex.find("uniform mat4 clip_from_object"), std::string::npos);
  }
}

TEST(BenchSmallFrame, HasItsOwnSizeForTheRivalToo) {
  const WorkloadEntry* const entry = find_workload("small-64x64");
  ASSERT_NE(entry, nullptr);
  const std::unique_ptr<Workload> workload = entry->make(kSetup);
  EXPECT_EQ(workload->fault(), "");
  EXPECT_EQ(workload->picture().width, 64);
  EXPECT_EQ(workload->picture().height, 64);
  EXPECT_EQ(workload->work(workload->draw()).triangles, 400u);
  const std::optional<GlWorkload> gl = entry->gl_workload(kSetup);
  ASSERT_TRUE(gl.has_value());
  EXPECT_EQ(gl->width, 64);
  EXPECT_EQ(gl->height, 64);
}

TEST(BenchTexturedSphere, ShowsItsTexture) {
  const WorkloadEntry* const entry = find_workload("textured-20k");
  ASSERT_NE(entry, nullptr);
  const std::unique_ptr<Workload> workload = entry->make(kSetup);
  EXPECT_EQ(workload->fault(), "");
  const std::unique_ptr<Workload> plain = find_workload("vertex-20k-1")->make(kSetup);
  EXPECT_EQ(plain->fault(), "");
  int darker = 0;
  for (std::size_t i = 0; i < plain->picture().rgba.size(); i += 4) {
    EXPECT_LE(std::abs(workload->picture().rgba[i] - plain->picture().rgba[i]), 1)
        << "red is 1 in all texels";
    darker += workload->picture().rgba[i + 1] < plain->picture().rgba[i + 1] ? 1 : 0;
  }
  EXPECT_GT(darker, kWidth * kHeight / 10) << "green varies";
  const std::optional<GlWorkload> gl = entry->gl_workload(kSetup);
  ASSERT_TRUE(gl.has_value());
  EXPECT_EQ(gl->texels.size(), 4u * 512 * 512);
}

TEST(BenchSamples, AreDrawnByTheRivalToo) {
  const std::optional<GlWorkload> gl = find_workload("samples-4")->gl_workload(kSetup);
  ASSERT_TRUE(gl.has_value());
  EXPECT_EQ(gl->samples, 4);
  EXPECT_EQ(find_workload("grid-80k")->gl_workload(kSetup)->samples, 1);
}

}  // namespace
}  // namespace tessera::bench::stage_workloads_test
