#include "engine/cli/selftest_ways.h"

namespace tessera::cli {

Ways every_way(int threads) {
  Ways ways;
  for (const InstructionSet set : available_instruction_sets())
    for (const int n : threads == 1 ? std::vector<int>{1} : std::vector<int>{1, threads})
      for (const int tile_size : {32, 64, 128})
        for (const bool defer : {true, false})
          ways.push_back(
              {.threads = n, .tile_size = tile_size, .instruction_set = set, .defer_shading = defer});
  return ways;
}

Ways few_ways(int threads) {
  Ways ways;
  for (const InstructionSet set : available_instruction_sets()) {
    ways.push_back({.threads = 1, .tile_size = 64, .instruction_set = set});
    ways.push_back({.threads = threads, .tile_size = 32, .instruction_set = set});
  }
  return ways;
}

std::string to_text(const RendererOptions& way) {
  return std::string(name(way.instruction_set)) + ", " + std::to_string(way.threads) +
         (way.threads == 1 ? " thread" : " threads") + ", tiles of " + std::to_string(way.tile_size) +
         (way.defer_shading ? "" : ", shaded at once");
}

}  // namespace tessera::cli
