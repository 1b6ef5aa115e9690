// The one place where the instruction set is chosen. Kernels are compiled once for each set (see lanes.h) and
// picked from a table by InstructionSet, once a frame; algorithms do not know which one runs.
#pragma once

#include <cstdint>
#include <vector>

#include "framebuffer/tessera/enums.hpp"

namespace tessera::detail {

/// Those compiled in that this machine can run, best first; always ends with scalar (the build's baseline).
std::vector<InstructionSet> available_isas();

/// Whether this machine has AVX-512 with products of bit matrices (GFNI): the storing of planes has a faster
/// way with them, to the same bits.
bool machine_has_gfni();
/// Whether AVX-512 is quicker at gathering pairs of words than at loading them one by one, to the same bits:
/// Intel's since Sapphire Rapids. These two are all that is chosen beside the set.
bool machine_has_fast_gather();

}  // namespace tessera::detail
