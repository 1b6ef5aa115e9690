// What `tessera bench` is asked for.
#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "engine/tessera/tessera.hpp"
#include "perf/bench/measure.h"
#include "perf/rivals/mesa_workload.h"

namespace tessera::bench {

struct BenchOptions {
  std::vector<std::string> names{};  ///< or their beginnings; empty: all
  bool list = false;
  int width = 1920, height = 1080;  ///< pixels
  RendererOptions renderer{};
  std::vector<int> cores{};  ///< that the process is kept on; empty: all it may use
  MeasureOptions measure{};
  bool rivals = false;  ///< draw the same in turns
  rivals::MesaDriver driver = rivals::MesaDriver::llvmpipe;
  bool scaling = false;  ///< on 1 thread and more, instead of rates
  int memory_cores = 8;  ///< that copy all that the memory of computed machines does
  std::string growth_file{};
  std::string trace_file{}, heatmap_file{};
  std::string json_file{}, csv_file{};  ///< "-": the standard output
  std::string compare_file{};
  std::string pictures_folder{};  ///< empty: none are written
  double allowed = 0.1;           ///< share by which a row may be slower than in that file
};

/// What the command line has, into `options`, which has to live as long as the program.
void add_options(CLI::App& program, BenchOptions& options);

}  // namespace tessera::bench
