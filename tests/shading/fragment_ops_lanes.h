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
  const std::int32_t* stored;  ///< packed colors or stencil values
  /// Stencil: 0 failed the stencil test, 1 failed the depth test, 2 passed both.
  const std::int32_t* outcome;
  float threshold;
  std::int32_t* words;  ///< out
};

/// Blends (if enabled), quantizes and applies the logic operation.
using StoreFragments = void(const FragmentOps& ops, const ColorLayout& layout, const FragmentArrays& arrays);
/// Stencil: bit 8 of `words` is whether the test passes, the lower bits are the resulting value.
using TestStencil = void(const StencilSide& side, std::int32_t most, const FragmentArrays& arrays);

StoreFragments* store_fragments(InstructionSet isa);
TestStencil* test_stencil(InstructionSet isa);

}  // namespace tessera::test
