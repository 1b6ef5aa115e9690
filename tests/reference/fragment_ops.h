// The per-fragment operations: pure functions of incoming and stored values.
#pragma once

#include "fragment_state.h"

namespace tessera::reference {

template <class T>
bool passes(Compare test, T incoming, T stored) {
  switch (test) {
    case Compare::kNever: return false;
    case Compare::kLess: return incoming < stored;
    case Compare::kEqual: return incoming == stored;
    case Compare::kLequal: return incoming <= stored;
    case Compare::kGreater: return incoming > stored;
    case Compare::kNotequal: return incoming != stored;
    case Compare::kGequal: return incoming >= stored;
    case Compare::kAlways: return true;
  }
  return false;
}

/// @param stored  value in a buffer of `bits` bits
bool passes_stencil(const StencilFace& face, std::uint32_t stored, int bits);

/// Returns the stencil value after `op` through the write mask.
std::uint32_t stencil_after(StencilOp op, const StencilFace& face, std::uint32_t stored, int bits);

/// @param source  0..1
/// @param destination  as read back from the buffer; alpha 1 if it has none
/// @return not clamped
Vec4 blended(const Blend& blend, Vec4 source, Vec4 destination);

/// Combines all 32 bits; bits beyond the buffer's are meaningless.
std::uint32_t combined(LogicOp op, std::uint32_t source, std::uint32_t destination);

/// Threshold of ordered dither, between 0 and 1; 0.5 without dither, which rounds.
/// @param x, y  window coordinates of the pixel, y up.
double dither_threshold(Dither dither, int x, int y);

}  // namespace tessera::reference
