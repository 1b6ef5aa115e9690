// The configurations in which the self-test renders the same thing.
#pragma once

#include <string>
#include <vector>

#include "engine/tessera/tessera.hpp"

namespace tessera::program::cli {

using Configurations = std::vector<RendererOptions>;

/// Every instruction set of this machine, 1 and `threads` threads, every tile size, shaded late and at once.
Configurations all_configurations(int threads);
/// Two of each instruction set.
Configurations few_configurations(int threads);

/// "avx2, 2 threads, tiles of 32, shaded at once"
std::string to_text(const RendererOptions& configuration);

}  // namespace tessera::program::cli
