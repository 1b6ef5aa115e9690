// Command line of `tessera accuracy`.
#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "engine/tessera/tessera.hpp"

namespace tessera::accuracy {

struct AccuracyOptions {
  std::vector<std::string> files{};  ///< scenes and models, in addition to the built-in scenes
  std::string folder{};              ///< receives all outputs
  bool is_quick = false;
  int threads = 0;                    ///< 0: two, or one if there is one core only
  int rounds = 0;                     ///< 0: 31, or 9 with is_quick
  std::vector<std::string> scenes{};  ///< names of built-in scenes, or prefixes of them; empty: all
  InstructionSet instruction_set = InstructionSet::automatic;
  int time_process = -1;  ///< measures the rounds of this process; -1: the program that the user started
};

void add_options(CLI::App& program, AccuracyOptions& options);

}  // namespace tessera::accuracy
