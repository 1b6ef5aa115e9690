// The power function's kernels, which only translation units for many targets can see, as plain functions
// over arrays.
#pragma once

#include <cstddef>

#include "framebuffer/instruction_set.h"

namespace tessera::test {
using namespace detail;

enum class PowerFunction { power, log2, exp2, chosen };
/// Of `count` arguments, a multiple of 16; the exponent matters to powers alone. `chosen`: in the way that
/// lighting takes.
using EvaluatePower = void(PowerFunction function, const float* arguments, float exponent, float* results,
                           std::size_t count);
EvaluatePower* evaluate_power(InstructionSet isa);

}  // namespace tessera::test
