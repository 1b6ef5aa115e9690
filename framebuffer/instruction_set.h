// The choice of the instruction set. Kernels are compiled once per set (see lanes.h) and selected by
// InstructionSet once per frame, never inside an algorithm.
#pragma once

#include <cstdint>
#include <vector>

#include "framebuffer/tessera/enums.hpp"

namespace tessera::detail {

/// Instruction sets that are compiled in and that this machine runs, best first. The last one is always
/// scalar.
std::vector<InstructionSet> available_isas();

// Two machine properties select faster code within AVX-512, with the same bits.

/// True if this machine has AVX-512 and GFNI (products of bit matrices): planes are stored in whole cache
/// lines.
bool machine_has_gfni();
/// True if AVX-512 gathers pairs of 32-bit words faster than single loads do: Intel since Sapphire Rapids.
bool machine_has_fast_gather();

}  // namespace tessera::detail
