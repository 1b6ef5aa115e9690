// Formats statistics of a run as text or as JSON.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "engine/tessera/tessera.hpp"

namespace tessera::program::cli {

enum class StatsFormat { none, text, json };

struct RunStats {
  FrameStats frame;  ///< statistics of the last frame
  RendererOptions options;
  double load_ms = 0;
  double write_ms = 0;
  std::vector<double> render_ms;  ///< one per rendering
  /// Memory of the planes of colour, depth, stencil and accumulation.
  std::array<std::size_t, 4> buffer_bytes{};
};

std::string stats_text(const RunStats& stats);
std::string stats_json(const RunStats& stats);

}  // namespace tessera::program::cli
