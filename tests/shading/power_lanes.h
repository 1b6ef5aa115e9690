// Kernels of the power functions, which are only visible to multi-target translation units, as plain
// functions over arrays.
#pragma once

#include <cstddef>

#include "framebuffer/instruction_set.h"

namespace tessera::test {
using namespace detail;

enum class PowerFunction { power, log2, exp2, chosen };
/// Evaluates `count` arguments, a multiple of 16. The exponent matters to powers only; `chosen` is the method
/// that lighting uses.
using EvaluatePower = void(PowerFunction function, const float* arguments, float exponent, float* results,
                           std::size_t count);
EvaluatePower* evaluate_power(InstructionSet isa);

}  // namespace tessera::test
