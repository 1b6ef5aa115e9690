#include "engine/program/cli/selftest_configurations.h"

namespace tessera::program::cli {

Configurations all_configurations(int threads) {
  Configurations configurations;
  for (const InstructionSet set : available_instruction_sets())
    for (const int n : threads == 1 ? std::vector<int>{1} : std::vector<int>{1, threads})
      for (const int tile_size : {32, 64, 128})
        for (const bool defer : {true, false})
          configurations.push_back({.threads = n,
                                    .tile_size = tile_size,
                                    .instruction_set = set,
                                    .debug = {.defer_shading = defer}});
  return configurations;
}

Configurations few_configurations(int threads) {
  Configurations configurations;
  for (const InstructionSet set : available_instruction_sets()) {
    configurations.push_back({.threads = 1, .tile_size = 64, .instruction_set = set});
    configurations.push_back({.threads = threads, .tile_size = 32, .instruction_set = set});
  }
  return configurations;
}

std::string to_text(const RendererOptions& configuration) {
  return std::string(name(configuration.instruction_set)) + ", " + std::to_string(configuration.threads) +
         (configuration.threads == 1 ? " thread" : " threads") + ", tiles of " +
         std::to_string(configuration.tile_size) +
         (configuration.debug.defer_shading ? "" : ", immediate shading");
}

}  // namespace tessera::program::cli
