// Arguments and outputs that `tessera bench` refuses.
#ifdef TESSERA_PROGRAM
#include <gtest/gtest.h>

#include <filesystem>

#include "tests/engine/program/bench_program.h"

namespace tessera::bench_program_errors_test {
namespace {

class BenchProgramErrors : public BenchProgram {};

// Errors are found before anything is measured, drawn or written.
TEST_F(BenchProgramErrors, ChecksOutputsBeforeMeasuring) {
  write("kept.json", "kept");
  write("larger.json", R"({"width": 65, "height": 48, "threads": 1, "instruction_set": "scalar", )"
                       R"("workloads": [{"name": "fill-flat", "median_ms": 1}]})");
  std::filesystem::create_symlink("none/report.json", folder_ / "broken.json");
  std::filesystem::create_symlink("none_yet.json", folder_ / "broken_too.json");
  const struct {
    const char *arguments, *message;
    int code;
  } cases[] = {
      {"fill --json new.json --cores 1023,1022",
       "--cores: found 1023,1022, which this process may not use, expected some of ", 2},
      {"fill --pictures new.json --cores 1023",
       "--cores: found 1023, which this process may not use, expected some of ", 2},
      {"fill --json kept.json --cores 1023",
       "--cores: found 1023, which this process may not use, expected some of ", 2},
      {"fill --json new.json --compare larger.json",
       "larger.json: frames are 65x48, expected 64x48, the size of this run", 1},
      {"fill --json new.json --csv none/report.csv",
       "cannot write \"none/report.csv\": there is no folder \"none\"", 1},
      {"fill --json kept.json/report.json",
       "cannot write \"kept.json/report.json\": there is no folder \"kept.json\"", 1},
      {"fill --json broken.json", "cannot write \"broken.json\": there is no folder \"none\"", 1},
      {"fill --json new.json --pictures kept.json", "cannot create the folder \"kept.json\"", 1},
      {"fill --json new.json --csv ./new.json",
       "--csv: found \"./new.json\", which is also the file of --json, expected another one", 2},
      {"fill --json new.json --pictures new.json",
       "--pictures: found \"new.json\", which is also the file of --json", 2},
      {"fill --json broken_too.json --csv none_yet.json",
       "--csv: found \"none_yet.json\", which is also the file of --json", 2},
      {"fill --json new.json --pictures new.json/",
       "--pictures: found \"new.json/\", which is also the file of --json", 2},
      {"fill --json new.json --pictures new.json/all",
       "--pictures: found \"new.json/all\", which is also the file of --json", 2},
      {"fill --trace new.json --heatmap map.png", "--heatmap: found 10 workloads", 2},
      {"fill-flat --trace new.json --heatmap map", "cannot write \"map\": the name has no extension", 1},
      {"fill-flat --trace - --heatmap none/map.ppm",
       "cannot write \"none/map.ppm\": there is no folder \"none\"", 1},
      {"store-24 --trace new.json --heatmap map.ppm",
       "store-24: is not drawn by a renderer, so there is no heatmap", 1},
      {"--growth none/growth.svg", "cannot write \"none/growth.svg\"", 1}};
  for (const auto& [arguments, message, code] : cases) {
    const bool traces = contains(arguments, "--trace");  // one frame: neither repeats nor seconds
    const Result refused =
        run(std::string("bench --size 64x48 ") + (traces ? "" : "--repeats 2 --seconds 0.001 ") + arguments);
    EXPECT_EQ(refused.code, code) << arguments << "\n" << refused.err;
    EXPECT_TRUE(contains(refused.err, message)) << arguments << "\n" << refused.err;
    EXPECT_EQ(refused.out, "") << arguments;
    EXPECT_FALSE(exists("new.json")) << arguments;
  }
  EXPECT_EQ(content("kept.json"), "kept");
  // The output is checked before the workload is drawn.
  const Result trace = run("bench store-24 --size 32x32 --trace none/trace.json");
  EXPECT_EQ(trace.code, 1);
  EXPECT_FALSE(contains(trace.err, "is not drawn by a renderer")) << trace.err;
}

// An error even if other names select workloads that can run.
TEST_F(BenchProgramErrors, RejectsNameWithoutRunnableWorkload) {
  if (std::filesystem::exists("/usr/share/doc/opencv-doc/examples/surface_matching/data/rs1_normals.ply"))
    GTEST_SKIP() << "the model is installed";
  for (const char* names : {"model-rs1", "fill-flat model-rs1"}) {
    const Result result = run("bench --size 32x32 --repeats 1 --seconds 0.001 " + std::string(names));
    EXPECT_EQ(result.code, 1) << names;
    EXPECT_TRUE(
        contains(result.err, "no workload of \"model-rs1\" can run: needs /usr/share/doc/opencv-doc/"))
        << names << "\n"
        << result.err;
  }
  EXPECT_TRUE(contains(run("bench --list").out, "(not in the mean): needs /usr/share/doc/opencv-doc/"));
}

TEST_F(BenchProgramErrors, FailsIfTheStandardOutputIsFull) {
  if (!has_full_disk()) GTEST_SKIP() << "no /dev/full";
  for (const char* arguments :
       {"bench --help", "bench --list", "bench fill-flat --size 32x32 --repeats 1 --seconds 0.001",
        "bench fill-flat --size 32x32 --repeats 1 --seconds 0.001 --csv -"}) {
    const Result result = run_without_room(arguments);
    EXPECT_EQ(result.code, 1) << arguments;
    EXPECT_TRUE(contains(result.err, "tessera bench: error: cannot write to the standard output"))
        << arguments << "\n"
        << result.err;
  }
}

TEST_F(BenchProgramErrors, RejectsInvalidArguments) {
  write("other.json", R"({"width": 1, "height": 1, "threads": 1, "instruction_set": "avx2", )"
                      R"("workloads": [{"median_ms": 1}]})");
  write("older.json", R"({"width": 1, "threads": 1, "instruction_set": "avx2", "workloads": []})");
  const struct {
    const char *arguments, *message;
    int code;
  } cases[] = {{"nothing", "found \"nothing\", expected the name of a workload or a prefix", 2},
               {"''", "found \"\", expected the name of a workload or a prefix", 2},
               {"--compare ''", "--compare: found \"\", expected FILE to be a non-empty name", 2},
               {"--pictures ''", "--pictures: found \"\", expected DIR to be a non-empty name", 2},
               {"--size 0x4", "found \"0x4\", expected WIDTHxHEIGHT, each 1 to 16384", 2},
               {"--threads 0", "found \"0\", expected N, 1 to 1024", 2},
               {"--tile-size 48", "found \"48\", expected 32|64|128", 2},
               {"--isa sse", "found \"sse\", expected scalar|avx2|avx512", 2},
               {"--cores 0,,1", "found \"0,,1\"", 2},
               {"--seconds nan", "found \"nan\", expected S, 0.001 to 3600", 2},
               {"--seconds 0", "found \"0\", expected S, 0.001 to 3600", 2},
               {"--seed -1", "found \"-1\", expected N, 0 to 4294967295", 2},
               {"--compare other.json --allowed nan", "found \"nan\", expected SHARE, 0 to 100", 2},
               {"--json - --csv -", "--csv: found \"-\", which is also the file of --json", 2},
               {"--json .", "cannot write \".\": Is a directory", 1},
               {"--compare missing.json", "missing.json", 1},
               {"--compare other.json", "found an object, expected a workload with its name", 1},
               {"--compare older.json", "found no \"height\", expected a report of tessera bench --json", 1},
               {"--memory-cores 4", "--memory-cores: needs --scaling", 2},
               {"--rivals --driver swr", "found \"swr\", expected llvmpipe|softpipe", 2},
               {"--rivals --scaling", "--scaling: excludes --rivals", 2},
               {"--driver softpipe", "--driver: needs --rivals", 2},
               {"--trace t.json --json -", "--json", 2},
               {"--fast", "--fast", 2}};
  for (const auto& [arguments, message, code] : cases) {
    const Result refused = run(std::string(kQuick) + arguments);
    EXPECT_EQ(refused.code, code) << arguments << "\n" << refused.err;
    EXPECT_TRUE(contains(refused.err, message)) << arguments << "\n" << refused.err;
    EXPECT_EQ(refused.out, "") << arguments;
  }
}

}  // namespace
}  // namespace tessera::bench_program_errors_test
#endif
