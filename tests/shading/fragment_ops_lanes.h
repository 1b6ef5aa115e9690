// Fragment operations over arrays whose length is a multiple of 16, on each instruction set.
#pragma once

#include <cstddef>
#include <cstdint>

#include "framebuffer/format.h"
#include "framebuffer/instruction_set.h"
#include "shading/fragment_ops.h"

namespace tessera::test {
using namespace detail;

struct FragmentArrays {
  std::size_t count;
  const float* source[4];      ///< r g b a
  const std::int32_t* stored;  ///< packed colours or stencil values
  /// Stencil: 0 the fragment is not covered, 1 its depth test would fail, 2 its depth test would pass.
  const std::int32_t* outcome;
  float threshold;
  std::int32_t* results;
};

/// Blends (if enabled), quantizes and applies the logic operation.
using StoreFragments = void(const FragmentOps& ops, const ColorLayout& layout, const FragmentArrays& arrays);
/// Stencil: the lower bits of a result are the new stencil value; bit 8 is set if the stencil test passes.
/// @param max_value  2^bits - 1
using TestStencil = void(const StencilSide& side, std::int32_t max_value, const FragmentArrays& arrays);

StoreFragments* store_fragments(InstructionSet isa);
TestStencil* test_stencil(InstructionSet isa);

}  // namespace tessera::test
