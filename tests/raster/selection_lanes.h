// greater_of() and lesser_of(), which only translation units for many targets can see, as plain functions
// over arrays.
#pragma once

#include <cstddef>

#include "framebuffer/instruction_set.h"

namespace tessera::test {
using namespace detail;

/// Of `count` pairs, a multiple of 16.
using Select = void(const float* a, const float* b, float* greater, float* lesser, std::size_t count);
Select* select(InstructionSet isa);

}  // namespace tessera::test
