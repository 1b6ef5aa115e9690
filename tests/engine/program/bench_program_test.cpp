// Output and exit codes of `tessera bench`. Times are not checked.
#ifdef TESSERA_PROGRAM
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <sstream>

#include <sched.h>

#include <nlohmann/json.hpp>

#include "tests/engine/program/bench_program.h"

namespace tessera::bench_program_test {
namespace {

using Json = nlohmann::json;

/// A logical CPU that this process and its children may use.
std::string allowed_core() { return std::to_string(::sched_getcpu()); }

TEST_F(BenchProgram, ListsWorkloads) {
  const Result list = run("bench --list");
  EXPECT_EQ(list.code, 0) << list.err;
  for (const char* name : {"fill-flat", "fill-blend", "fill-trilinear", "grid-2M", "vertex-500k-8",
                           "phong-20k-8-spot", "points-1M", "lines-1M", "bunny"})
    EXPECT_TRUE(contains(list.out, std::string(name) + " ")) << name;
}

TEST_F(BenchProgram, ReportsEveryWorkload) {
  const Result table = run(std::string(kQuick) + "--machine --json report.json --csv report.csv");
  ASSERT_EQ(table.code, 0) << table.out << table.err;
  for (const char* part :
       {"CPU", "instruction sets", "64x48", "fill-gouraud-z", "noise: fill-flat against itself", "L1 stores"})
    EXPECT_TRUE(contains(table.out, part)) << part << "\n" << table.out;
  const Json report = Json::parse(content("report.json"));
  EXPECT_EQ(report["width"], 64);
  EXPECT_TRUE(report["machine"].contains("CPU"));
  ASSERT_EQ(report["workloads"].size(), 10u);
  for (const Json& row : report["workloads"]) {
    EXPECT_EQ(row["frames"], 2);
    EXPECT_FALSE(row.contains("fault")) << row;
    EXPECT_GT(row["cold_ms"], 0);
    EXPECT_LE(row["min_ms"], row["median_ms"]);
    EXPECT_LE(row["median_ms"], row["percentile_99_ms"]);
    // fill-hidden defers shading, so it does not store 16 layers.
    EXPECT_EQ(row.value("roofline", ""), row["name"] == "fill-hidden" ? "" : "tile stores");
    EXPECT_EQ(row.value("share_of_roofline", 0.0) * row.value("roofline_gigabytes_per_second", 0.0) > 0,
              row.contains("roofline"))
        << row;
    EXPECT_EQ(row.value("share_of_l1_stores", 0.0) * row.value("l1_stores_gigabytes_per_second", 0.0) > 0,
              row.contains("roofline"))
        << row;
    if (row["name"] != "fill-hidden") {
      const bool stores_depth_or_stencil = row["name"] == "fill-gouraud-z" || row["name"] == "fill-stencil";
      EXPECT_EQ(row["tile_bytes"], (stores_depth_or_stencil ? 8 : 4) * 64 * 48) << "4 bytes per buffer";
      EXPECT_NEAR(row["megafragments_per_second"].get<double>() / row["megapixels_per_second"].get<double>(),
                  16, 1e-6)
          << row;
    }
    const double pixels_per_second = row["megapixels_per_second"].get<double>() * 1e6;
    const double ms = row["median_ms"];
    EXPECT_NEAR(pixels_per_second * ms * 1e-3, 64 * 48, 1);
  }
  for (const char* roofline :
       {"l1_stores", "tile_stores", "memory_stores", "memory_loads", "memory_loads_single_core"})
    EXPECT_GT(report["bandwidth_gigabytes_per_second"][roofline], 0) << roofline;
  // A heading and one row per workload, all with the same number of fields.
  const std::string csv = content("report.csv");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 11);
  const auto commas = [](const std::string& line) {  // between fields
    bool is_quoted = false;
    return std::count_if(line.begin(), line.end(), [&](char letter) {
      return is_quoted ^= letter == '"', letter == ',' && !is_quoted;
    });
  };
  const auto columns = commas(csv.substr(0, csv.find('\n')));
  std::istringstream lines(csv);
  for (std::string line; std::getline(lines, line);) EXPECT_EQ(commas(line), columns) << line;
  EXPECT_TRUE(contains(csv.substr(0, csv.find('\n')), ",CPU,")) << csv;
  EXPECT_TRUE(csv.starts_with("workload,threads,frames,median_ms,")) << csv;
}

#ifndef __SANITIZE_THREAD__  // its shadow memory is four times as large
// The memory of earlier workloads does not count.
TEST_F(BenchProgram, MeasuresMemoryPerWorkload) {
  const Result result = run("bench grid-500k vertex-500k --size 64x48 --repeats 1 --seconds 0.001 --json -");
  ASSERT_EQ(result.code, 0) << result.err;
  const Json rows = Json::parse(result.out)["workloads"];
  ASSERT_EQ(rows.size(), 3u);
  for (const Json& row : rows)
    EXPECT_TRUE(row["bytes_per_triangle"] > 4 && row["bytes_per_triangle"] < 64) << row;
}
#endif

// The machine itself is measured on request only: it takes longer than a row.
TEST_F(BenchProgram, MeasuresTheMachineOnRequest) {
  const Result table = run("bench fill-flat --size 64x48 --repeats 2 --seconds 0.001 --json report.json");
  ASSERT_EQ(table.code, 0) << table.err;
  for (const char* part : {"noise:", "bandwidth", "tile stores"})
    EXPECT_FALSE(contains(table.out, part)) << part << "\n" << table.out;
  for (const char* part : {"\nmedian ms ", "\nMfrag/s ", "\npeak MiB ", "machine drift: "})
    EXPECT_TRUE(contains(table.out, part)) << part << "\n" << table.out;
  const Json report = Json::parse(content("report.json"));
  EXPECT_FALSE(report.contains("noise"));
  EXPECT_FALSE(report.contains("bandwidth_gigabytes_per_second"));
  EXPECT_GT(report["workloads"][0]["reference_ms"], 0);
  EXPECT_LE(report["workloads"][0]["percentile_5_ms"], report["workloads"][0]["median_ms"]);
}

TEST_F(BenchProgram, WritesNothingButJsonToTheStandardOutput) {
  const Result json = run("bench fill-flat --size 32x32 --repeats 1 --seconds 0.001 --json -");
  ASSERT_EQ(json.code, 0) << json.err;
  EXPECT_EQ(Json::parse(json.out)["workloads"][0]["name"], "fill-flat");
}

/// Multiplies all times of a row.
void scale_times(Json& row, double factor) {
  for (const char* key : {"median_ms", "low_quartile_ms", "high_quartile_ms", "percentile_5_ms",
                          "percentile_95_ms", "percentile_99_ms", "min_ms"})
    row[key] = row[key].get<double>() * factor;
}

TEST_F(BenchProgram, ComparesWithEarlierReport) {
  const std::string kFour =
      "bench fill-flat fill-gouraud fill-nearest fill-blend --size 64x48 --repeats 2 --seconds 0.001 ";
  ASSERT_EQ(run(kFour + "--json now.json").code, 0);
  Json earlier = Json::parse(content("now.json"));
  for (Json& row : earlier["workloads"]) row["median_ms"] = 1e6;
  write("slow.json", earlier.dump());
  const Result faster = run(kFour + "--compare slow.json");
  EXPECT_EQ(faster.code, 0) << faster.out << faster.err;
  EXPECT_TRUE(contains(faster.out, "1000000.000")) << faster.out;
  EXPECT_FALSE(contains(faster.out, "settings differ")) << faster.out;
  earlier["threads"] = 77;
  write("other.json", earlier.dump());
  const Result others =
      run("bench fill-flat --size 64x48 --threads 1 --isa scalar --repeats 2 --seconds 0.001 --compare "
          "other.json");
  EXPECT_TRUE(contains(others.out, "settings differ: 64x48, 77 threads, ")) << others.out;
  EXPECT_TRUE(contains(others.out, " in other.json, now 64x48, 1 thread, scalar\n")) << others.out;
  EXPECT_TRUE(contains(others.out, "fill-blend: only in other.json")) << others.out;
  earlier = Json::parse(content("now.json"));
  for (Json& row : earlier["workloads"]) scale_times(row, 1e-6);
  earlier["workloads"].erase(0);
  write("fast.json", earlier.dump());
  const Result slower = run(kFour + "--compare fast.json");
  EXPECT_EQ(slower.code, 3) << slower.out << slower.err;
  EXPECT_TRUE(contains(slower.out, "  slower (measured 4 times)\n")) << slower.out;
  EXPECT_TRUE(contains(slower.out, "\n3 rows are slower: exit code 3\n")) << slower.out;
  EXPECT_TRUE(contains(slower.out, "fill-gouraud looks slower than in fast.json: measured again\n"))
      << slower.out;
  EXPECT_TRUE(contains(slower.out, "fill-flat: not in fast.json")) << slower.out;
  // Only the regressed row, if it is selected, fails the run.
  for (Json& row : earlier["workloads"]) scale_times(row, row["name"] == "fill-gouraud" ? 1 : 1e8);
  write("one.json", earlier.dump());
  EXPECT_EQ(run("bench fill-nearest --size 64x48 --repeats 2 --seconds 0.001 --compare one.json").code, 0);
  const Result nothing = run("bench fill-flat --size 64x48 --repeats 2 --seconds 0.001 --compare one.json");
  EXPECT_EQ(nothing.code, 1);
  EXPECT_TRUE(contains(nothing.err, "one.json: has none of the workloads to be measured")) << nothing.err;
  EXPECT_EQ(
      run("bench fill-gouraud --size 64x48 --repeats 2 --seconds 0.001 --compare one.json --allowed 100")
          .code,
      3);
  earlier = Json::parse(content("now.json"));
  // The same program does not fail, although two frames of microseconds say little.
  EXPECT_EQ(run(kFour + "--compare now.json --allowed 1").code, 0);
  // On a busy machine, frames of some microseconds may take several times as long as before.
  for (Json& row : earlier["workloads"]) scale_times(row, 1e-3);
  write("thousandth.json", earlier.dump());
  EXPECT_EQ(run(kFour + "--compare thousandth.json --allowed 0.1").code, 3);
  EXPECT_EQ(run(kFour + "--compare now.json --allowed 100").code, 0);
}

TEST_F(BenchProgram, NamesSettingsThatDifferFromTheEarlierRun) {
  const std::string kOne = "bench fill-flat --size 32x32 --repeats 1 --seconds 0.001 ";
  ASSERT_EQ(run(kOne + "--json now.json").code, 0);
  Json earlier = Json::parse(content("now.json"));
  EXPECT_EQ(earlier["tile_size"], 0);
  EXPECT_EQ(earlier["seed"], 1);
  EXPECT_EQ(earlier["kept_on_cores"], Json::array());
  EXPECT_FALSE(earlier["workloads"][0].contains("bytes_per_triangle")) << "too few triangles";
  earlier["machine"]["CPU"] = "another one";
  earlier["machine"]["compiler"] = "cfront 3.0";
  earlier["workloads"][0]["median_ms"] = 1e6;
  write("other.json", earlier.dump());
  const Result compared = run(kOne + "--seed 5 --tile-size 64 --compare other.json");
  EXPECT_EQ(compared.code, 0) << compared.err;
  for (const char* difference :
       {"tile_size differs: 0 in other.json, now 64\n", "seed differs: 1 in other.json, now 5\n",
        "CPU differs: \"another one\" in other.json, now \"",
        "compiler differs: \"cfront 3.0\" in other.json, now \""})
    EXPECT_TRUE(contains(compared.out, difference)) << difference << "\n" << compared.out;
  EXPECT_FALSE(contains(compared.out, "kept_on_cores differs")) << compared.out;
  // If the standard output carries JSON, the comparison goes to the standard error stream.
  const std::string core = allowed_core();
  const Result silent = run(kOne + "--cores " + core + " --json - --compare other.json");
  EXPECT_EQ(Json::parse(silent.out)["seed"], 1);
  EXPECT_TRUE(contains(silent.err, "kept_on_cores differs: [] in other.json, now [" + core + "]\n"))
      << silent.err;
  EXPECT_TRUE(contains(silent.err, "earlier/now")) << silent.err;
}

TEST_F(BenchProgram, NamesWorkloadsWithoutRenderer) {
  const Result trace = run("bench store-24 --size 32x32 --trace trace.json");
  EXPECT_EQ(trace.code, 0);
  EXPECT_TRUE(contains(trace.err, "store-24: is not drawn by a renderer, so its trace is empty"))
      << trace.err;
  const Result map = run("bench store-24 --size 32x32 --heatmap map.png");
  EXPECT_EQ(map.code, 1);
  EXPECT_TRUE(contains(map.err, "store-24: is not drawn by a renderer, so there is no heatmap")) << map.err;
}

TEST_F(BenchProgram, NamesWorkloadsWithoutRival) {
  const Result rivals = run("bench clear fill-flat --size 32x32 --repeats 1 --seconds 0.001 --rivals");
  if (contains(rivals.err, "libosmesa6")) GTEST_SKIP() << rivals.err;
  EXPECT_EQ(rivals.code, 0) << rivals.err;
  EXPECT_TRUE(contains(rivals.out, "not drawn by rivals: clear\n")) << rivals.out << rivals.err;
}

TEST_F(BenchProgram, ComparesWithRivals) {
  const Result table = run(std::string(kQuick) + "--rivals --machine --json report.json");
  if (contains(table.err, "libosmesa6")) GTEST_SKIP() << table.err;
  ASSERT_EQ(table.code, 0) << table.out << table.err;
  for (const char* part : {"rival: llvmpipe", "geometric mean of 9 ratios", "fill-flat against itself"})
    EXPECT_TRUE(contains(table.out, part)) << part << "\n" << table.out;
  const Json rival_comparisons = Json::parse(content("report.json"))["rival_comparisons"];
  ASSERT_EQ(rival_comparisons["workloads"].size(), 9u);
  EXPECT_GT(rival_comparisons["finish_ms"], 0);
  EXPECT_GT(rival_comparisons["finish_pixel_ms"], 0);
  for (const Json& row : rival_comparisons["workloads"]) {
    EXPECT_FALSE(row.contains("fault")) << row;
    for (const std::string prefix : {"", "rival_"}) {
      EXPECT_LE(row[prefix + "low_quartile_ms"], row[prefix + "median_ms"]);
      EXPECT_LE(row[prefix + "median_ms"], row[prefix + "high_quartile_ms"]);
    }
    EXPECT_NEAR(row["ratio"].get<double>(),
                row["rival_median_ms"].get<double>() / row["median_ms"].get<double>(), 1e-9);
    EXPECT_LE(row["low_ratio"], row["ratio"]);
    EXPECT_LE(row["ratio"], row["high_ratio"]);
  }
}

// Compares each operation with the picture without it, and in turns with its time.
TEST_F(BenchProgram, MeasuresCostOfOperations) {
  const Result result = run("bench operation --size 96x64 --repeats 1 --seconds 0.001 --json report.json");
  ASSERT_EQ(result.code, 0) << result.out << result.err;
  EXPECT_TRUE(contains(result.out, "\noperation-blend / operation-none ")) << result.out;
  const Json rows = Json::parse(content("report.json"))["workloads"];
  EXPECT_EQ(rows.size(), 11u);
  for (const Json& row : rows) {
    EXPECT_FALSE(row.contains("fault")) << row;
    const bool is_baseline = row["name"] == "operation-none";
    EXPECT_EQ(row.value("baseline", ""), is_baseline ? "" : "operation-none") << row;
    EXPECT_EQ(row.value("ratio_to_baseline", 0.0) > 0, !is_baseline) << row;
  }
}

TEST_F(BenchProgram, MeasuresWorkloadsOutsideTheMean) {
  for (const char* names :
       {"clear scan-out accumulation", "planes", "depth samples draws fill-hidden size-320x200"}) {
    const Result result =
        run("bench " + std::string(names) + " --size 64x48 --repeats 1 --seconds 0.001 --json -");
    ASSERT_EQ(result.code, 0) << result.out << result.err;
    const Json rows = Json::parse(result.out)["workloads"];
    EXPECT_GE(rows.size(), 3u) << names;
    for (const Json& row : rows) EXPECT_FALSE(row.contains("fault")) << row;
  }
}

TEST_F(BenchProgram, MeasuresMeshesPointsAndLines) {
  const Result result =
      run("bench vertex-20k-8 phong-20k-8-spot points-1M lines-1M --size 64x48 --repeats 1 --seconds 0.001 "
          "--json -");
  ASSERT_EQ(result.code, 0) << result.out << result.err;
  const Json rows = Json::parse(result.out)["workloads"];
  EXPECT_EQ(rows.size(), 4u);
  for (const Json& row : rows) EXPECT_FALSE(row.contains("fault")) << row;
}

TEST_F(BenchProgram, AppliesRendererOptions) {
  const std::string core = allowed_core();
  const Result result =
      run("bench grid-20k store-24 --size 64x48 --repeats 1 --seconds 0.001 --seed 7 --isa scalar "
          "--tile-size 64 --threads 1 --json - --cores " +
          core);
  ASSERT_EQ(result.code, 0) << result.out << result.err;
  const Json report = Json::parse(result.out);
  EXPECT_EQ(report["instruction_set"], "scalar");
  EXPECT_EQ(report["threads"], 1);
  EXPECT_EQ(report["seed"], 7);
  EXPECT_EQ(report["tile_size"], 64);
  EXPECT_EQ(report["kept_on_cores"], Json::array({std::stoi(core)}));
  for (const Json& row : report["workloads"]) EXPECT_FALSE(row.contains("fault")) << row;
}

TEST_F(BenchProgram, MatchesLightingOfRivals) {
  const Result table =
      run("bench vertex-20k-8 phong-20k-1 phong-20k-8-spot textured small objects-1000 samples-4 --rivals "
          "--size 320x200 --repeats 1 --seconds 0.001 --json -");
  if (contains(table.err, "libosmesa6")) GTEST_SKIP() << table.err;
  ASSERT_EQ(table.code, 0) << table.out << table.err;
  const Json report = Json::parse(table.out);
  for (const Json& row : report["rival_comparisons"]["workloads"]) EXPECT_FALSE(row.contains("fault")) << row;
}

TEST_F(BenchProgram, TracesOneFramePerWorkload) {
  const Result result = run("bench fill-flat grid-20k --size 96x64 --threads 2 --trace trace.json");
  ASSERT_EQ(result.code, 0) << result.err;
  const Json trace = Json::parse(content("trace.json"));
  std::vector<std::string> workloads;
  std::map<std::string, int> tasks, threads;
  for (const Json& event : trace["traceEvents"])
    if (event["ph"] != "M") ++tasks[event["name"]];
    else if (event["name"] == "thread_name") ++threads[event["args"]["name"]];
    else workloads.push_back(event["args"]["name"]);
  EXPECT_TRUE(threads.contains("worker 0") && threads.size() <= 2) << trace;
  EXPECT_EQ(workloads, (std::vector<std::string>{"fill-flat", "grid-20k"}));
  for (const char* stage : {"vertices", "binning", "tiles"}) EXPECT_GT(tasks[stage], 1) << stage;
}

TEST_F(BenchProgram, WritesHeatmapOfTileCosts) {
  const Result result = run("bench grid-20k --size 96x64 --tile-size 32 --heatmap map.ppm");
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_TRUE(contains(result.out, "nanoseconds of one thread per pixel")) << result.out;
  const std::string picture = content("map.ppm");
  // Frame and heatmap next to each other, and the key below.
  ASSERT_TRUE(picture.starts_with("P6\n400 136\n255\n")) << picture.substr(0, 20);
  EXPECT_TRUE(contains(picture, "\xff\xff\xff")) << "the most expensive tile is white";
}

TEST_F(BenchProgram, PredictsSpeedUpOnMoreCores) {
  const Result result =
      run("bench grid-20k --size 96x64 --threads 2 --repeats 2 --seconds 0.001 --scaling --json report.json");
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_TRUE(contains(result.out, "one core copies")) << result.out;
  const Json report = Json::parse(content("report.json"));
  const Json& scaling = report["scaling"];
  EXPECT_EQ(report["core_model"]["bandwidth_saturating_cores"], 8);
  for (const char* measured : {"core_copy_gigabytes_per_second", "barrier_seconds"})
    EXPECT_GT(report["core_model"][measured], 0) << measured;
  ASSERT_EQ(scaling.size(), 1u);
  EXPECT_GT(scaling[0]["measured"]["2"]["speed_up"], 0.0);
  EXPECT_LE(scaling[0]["measured"]["2"]["low"], scaling[0]["measured"]["2"]["high"]);
  EXPECT_GT(scaling[0]["independent_renderers"]["speed_up"], 0.0);
  EXPECT_TRUE(contains(result.out, " 2 independent ")) << result.out;
  for (const char* cores : {"2", "4", "8", "16", "32", "64", "128"})
    EXPECT_GT(scaling[0]["computed"][cores], 0.0) << cores;
}

TEST_F(BenchProgram, ReadsThreadCountFromTheEnvironment) {
  const std::string kOne = "bench fill-flat --size 32x32 --repeats 1 --seconds 0.001 --json - ";
  ::setenv("TESSERA_THREADS", "3", 1);
  const Result three = run(kOne);
  const Result two = run(kOne + "--threads 2");
  ::setenv("TESSERA_THREADS", "many", 1);
  const Result wrong = run(kOne);
  ::unsetenv("TESSERA_THREADS");
  EXPECT_EQ(Json::parse(three.out)["threads"], 3) << three.err;
  EXPECT_EQ(Json::parse(two.out)["threads"], 2) << two.err;
  EXPECT_EQ(wrong.code, 2) << wrong.err;
  EXPECT_TRUE(contains(wrong.err, "found \"many\"")) << wrong.err;
}

}  // namespace
}  // namespace tessera::bench_program_test
#endif
