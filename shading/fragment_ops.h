// What happens to a fragment on its way into the frame buffer: alpha test, stencil, depth, blend, dither,
// logic operation, masks, in this order [GL 2.1, 4.1]. Draws that have none of it never come here.
#pragma once

#include <array>
#include <cstdint>

#include "framebuffer/tessera/enums.hpp"

namespace tessera::detail {

/// Passes where (reference & mask) func (stored & mask).
struct StencilSide {
  Compare func = Compare::always;
  std::int32_t reference = 0;  ///< cut to the buffer's bits
  std::int32_t mask = 0xff;
  StencilOp fail = StencilOp::keep, zfail = StencilOp::keep, zpass = StencilOp::keep;
  std::int32_t write_mask = 0xff;

  constexpr bool writes() const {
    return write_mask != 0 &&
           (fail != StencilOp::keep || zfail != StencilOp::keep || zpass != StencilOp::keep);
  }
};

inline constexpr int kDitherSize = 8;  ///< patterns repeat after so many pixels at most

struct FragmentOps {
  bool alpha_test = false;
  Compare alpha_func = Compare::greater;
  float alpha_reference = 0.5f;

  bool stencil = false;
  StencilSide faces[2];             ///< front, back
  std::int32_t stencil_max = 0xff;  ///< 2^bits - 1

  bool blend = false;
  BlendFactor src_color = BlendFactor::src_alpha, dst_color = BlendFactor::one_minus_src_alpha,
              src_alpha = BlendFactor::src_alpha, dst_alpha = BlendFactor::one_minus_src_alpha;
  BlendEquation equation = BlendEquation::add;
  std::array<float, 4> constant{};  ///< 0..1

  bool dither = false;
  /// What is added before a level is cut off, by raster row and column; without dither 0.5 everywhere.
  float threshold[kDitherSize][kDitherSize] = {};
  float palette_spread = 0;  ///< index buffers: how far (threshold - 0.5) moves the colour that is looked up

  LogicOp logic = LogicOp::copy;
};

/// The thresholds of ordered dither of size n (2, 4, 8; 1: none): M_1 = [0], M_2n = [[4 M_n, 4 M_n + 2], [4
/// M_n + 3, 4 M_n + 1]], rows from the window's lower edge, (M[y mod n][x mod n] + 0.5) / n^2.
void set_dither(FragmentOps& ops, int n, int frame_height);

}  // namespace tessera::detail
