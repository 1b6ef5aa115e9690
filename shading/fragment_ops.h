// Fragment operations besides the depth test, in order: alpha test, stencil, depth, blend, dither, logic
// operation, masks [GL 2.1, 4.1].
#pragma once

#include <array>
#include <cstdint>

#include "framebuffer/color_dither.h"
#include "framebuffer/tessera/enums.hpp"

namespace tessera::detail {

/// Stencil test and actions of one face. Passes where (reference & mask) func (stored & mask).
/// Unlike StencilFace of the public interface, its values are signed, for lanes, and limited to the bits of
/// the stencil buffer.
struct StencilSide {
  Compare func = Compare::always;
  std::int32_t reference = 0;
  std::int32_t mask = 0xff;
  StencilOp fail = StencilOp::keep;   ///< the stencil test fails
  StencilOp zfail = StencilOp::keep;  ///< the stencil test passes, the depth test fails
  StencilOp zpass = StencilOp::keep;  ///< both pass
  std::int32_t write_mask = 0xff;

  constexpr bool writes() const {
    const bool has_action = fail != StencilOp::keep || zfail != StencilOp::keep || zpass != StencilOp::keep;
    return has_action && write_mask != 0;
  }
};

struct FragmentOps {
  bool alpha_test = false;
  Compare alpha_func = Compare::greater;
  float alpha_reference = 0.5f;

  bool stencil = false;
  StencilSide faces[2];             ///< front, back
  std::int32_t stencil_max = 0xff;  ///< 2^bits - 1

  bool blend = false;
  BlendFactor src_color = BlendFactor::src_alpha;
  BlendFactor dst_color = BlendFactor::one_minus_src_alpha;
  BlendFactor src_alpha = BlendFactor::src_alpha;
  BlendFactor dst_alpha = BlendFactor::one_minus_src_alpha;
  BlendEquation equation = BlendEquation::add;
  std::array<float, 4> constant{};  ///< 0..1

  const ColorDither* dither = nullptr;  ///< null: none

  LogicOp logic = LogicOp::copy;
};

}  // namespace tessera::detail
