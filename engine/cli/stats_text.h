// What a frame took, for people.
#pragma once

#include <string>

#include "engine/tessera/tessera.hpp"

namespace tessera::cli {

struct Times {
  double load_ms = 0, render_ms = 0, write_ms = 0;
};

std::string stats_text(const FrameStats& stats, const RendererOptions& options, const Times& times);

}  // namespace tessera::cli
