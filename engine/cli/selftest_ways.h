// The ways in which the self-test renders the same thing.
#pragma once

#include <string>
#include <vector>

#include "engine/tessera/tessera.hpp"

namespace tessera::cli {

using Ways = std::vector<RendererOptions>;

/// Every instruction set of this machine, 1 and `threads` threads, every tile size, shaded late and at once.
Ways every_way(int threads);
/// Two of each instruction set.
Ways few_ways(int threads);

/// "avx2, 2 threads, tiles of 32, shaded at once"
std::string to_text(const RendererOptions& way);

}  // namespace tessera::cli
