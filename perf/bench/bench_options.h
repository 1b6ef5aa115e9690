// Command line of `tessera bench`.
#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "engine/tessera/tessera.hpp"
#include "perf/bench/measure.h"
#include "perf/rivals/mesa_workload.h"

namespace tessera::bench {

struct BenchOptions {
  std::vector<std::string> names{};  ///< workload names or prefixes; empty: all
  bool list = false;
  int width = 1920, height = 1080;  ///< pixels
  RendererOptions renderer{};
  std::vector<int> cores{};  ///< logical CPUs to bind the process to; empty: all allowed ones
  MeasureOptions measure{};
  bool rivals = false;  ///< compare with Mesa
  rivals::MesaDriver driver = rivals::MesaDriver::llvmpipe;
  bool scaling = false;  ///< measure and predict speed-ups instead of rates
  bool machine = false;  ///< also measure noise, bandwidth, rooflines and latency between cores
  int memory_cores = 8;  ///< cores that saturate memory bandwidth in the model of many cores
  std::string growth_file{};
  std::string trace_file{};
  std::string heatmap_file{};
  std::string json_file{};  ///< "-": standard output
  std::string csv_file{};   ///< "-": standard output
  std::string compare_file{};
  std::string pictures_folder{};  ///< empty: no pictures are written
  double allowed = 0.1;           ///< share by which a row may be slower than in `compare_file`
};

/// Adds the options to `program`. Parsing writes to `options`, which must outlive `program`.
void add_options(CLI::App& program, BenchOptions& options);

}  // namespace tessera::bench
