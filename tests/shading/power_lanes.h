// Kernels of the power functions as plain functions over arrays.
#pragma once

#include <cstddef>

#include "framebuffer/instruction_set.h"

namespace tessera::test {
using namespace detail;

enum class PowerFunction { power, log2, exp2, chosen };
/// Evaluates a function at `count` arguments, a multiple of 16.
/// @param function  `chosen` is x^exponent by the method that lighting uses
/// @param exponent  unused by log2 and exp2
using EvaluatePower = void(PowerFunction function, const float* arguments, float exponent, float* results,
                           std::size_t count);
EvaluatePower* evaluate_power(InstructionSet isa);

}  // namespace tessera::test
