// The renderer configurations that the self-test compares.
#pragma once

#include <string>
#include <vector>

#include "engine/tessera/tessera.hpp"

namespace tessera::program::cli {

using Configurations = std::vector<RendererOptions>;

/// Returns all combinations of the machine's instruction sets, 1 and `threads` threads, every tile size,
/// deferred and immediate shading.
Configurations all_configurations(int threads);
/// Returns two configurations per instruction set.
Configurations few_configurations(int threads);

/// Returns "avx2, 2 threads, tiles of 32, immediate shading".
std::string to_text(const RendererOptions& configuration);

}  // namespace tessera::program::cli
