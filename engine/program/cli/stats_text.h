// What frames took, for people and for programs.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "engine/tessera/tessera.hpp"

namespace tessera::program::cli {

enum class StatsFormat { none, text, json };

struct RunStats {
  FrameStats frame;  ///< of the last frame rendered
  RendererOptions options;
  double load_ms = 0, write_ms = 0;
  std::vector<double> render_ms;  ///< of every rendering
  std::array<std::size_t, 4>
      buffer_bytes{};  ///< colour, depth, stencil, accumulation: what their planes take
};

std::string stats_text(const RunStats& stats);
std::string stats_json(const RunStats& stats);

}  // namespace tessera::program::cli
