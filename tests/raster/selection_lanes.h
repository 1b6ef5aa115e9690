// greater_of() and lesser_of() as plain functions over arrays, compiled for every instruction set.
#pragma once

#include <cstddef>

#include "framebuffer/instruction_set.h"

namespace tessera::test {
using namespace detail;

/// Applies both to `count` pairs. @pre count is a multiple of 16
using Select = void(const float* a, const float* b, float* greater, float* lesser, std::size_t count);
Select* select(InstructionSet isa);

}  // namespace tessera::test
