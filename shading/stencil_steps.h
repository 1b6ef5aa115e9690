// Stencil test and actions as constants, so that pixels go through them without a branch on what they are.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>

#include "shading/fragment_ops.h"

namespace tessera {

/// An action: min(max(((stored & keep) ^ flip) + add, least), most), of which the bits that may be written are stored.
struct StencilStep {
  std::int32_t keep = -1, flip = 0, add = 0;
  std::int32_t least = std::numeric_limits<std::int32_t>::min(), most = std::numeric_limits<std::int32_t>::max();

  constexpr std::int32_t operator()(std::int32_t stored) const { return std::min(std::max(((stored & keep) ^ flip) + add, least), most); }
};

constexpr StencilStep stencil_step(StencilAction action, std::int32_t reference, std::int32_t most) {
  switch (action) {
    case StencilAction::zero: return {.keep = 0};
    case StencilAction::replace: return {.keep = 0, .flip = reference};
    case StencilAction::incr: return {.add = 1, .most = most};
    case StencilAction::decr: return {.add = -1, .least = 0};
    case StencilAction::invert: return {.flip = -1};
    case StencilAction::incr_wrap: return {.add = 1};
    case StencilAction::decr_wrap: return {.add = -1};
    default: return {};
  }
}

struct StencilSteps {
  CompareOp func = CompareOp::always;
  std::int32_t reference = 0, mask = 0;  ///< the reference is masked already
  std::int32_t write_mask = 0;
  StencilStep fail, zfail, zpass;

  constexpr bool writes() const { return write_mask != 0; }
};

/// @param most  of the buffer: 2^bits - 1
constexpr StencilSteps stencil_steps(const StencilSide& face, std::int32_t most) {
  return {.func = face.func,
          .reference = face.reference & face.mask,
          .mask = face.mask,
          .write_mask = face.writes() ? face.write_mask & most : 0,
          .fail = stencil_step(face.fail, face.reference, most),
          .zfail = stencil_step(face.zfail, face.reference, most),
          .zpass = stencil_step(face.zpass, face.reference, most)};
}

}  // namespace tessera
