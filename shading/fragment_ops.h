// Fragment operations besides the depth test, in order: alpha test, stencil, depth, blend, dither, logic
// operation, masks [GL 2.1, 4.1].
#pragma once

#include <array>
#include <cstdint>

#include "framebuffer/tessera/enums.hpp"

namespace tessera::detail {

/// Passes where (reference & mask) func (stored & mask).
struct StencilSide {
  Compare func = Compare::always;
  std::int32_t reference = 0;  ///< clamped to the buffer's range
  std::int32_t mask = 0xff;
  StencilOp fail = StencilOp::keep, zfail = StencilOp::keep, zpass = StencilOp::keep;
  std::int32_t write_mask = 0xff;

  constexpr bool writes() const {
    return write_mask != 0 &&
           (fail != StencilOp::keep || zfail != StencilOp::keep || zpass != StencilOp::keep);
  }
};

inline constexpr int kDitherSize = 8;  ///< largest period of a dither pattern, pixels

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
  /// Rounding offset added before truncation to a level, by raster row and column; without dither 0.5.
  float threshold[kDitherSize][kDitherSize] = {};
  /// Index buffers: the color is moved by (threshold - 0.5) * palette_spread before the palette search.
  float palette_spread = 0;

  LogicOp logic = LogicOp::copy;
};

/// Sets the thresholds of ordered dither of size n (2, 4, 8; 1: none): M_1 = [0], M_2n = [[4 M_n, 4 M_n + 2],
/// [4 M_n + 3, 4 M_n + 1]], rows from the window's lower edge, (M[y mod n][x mod n] + 0.5) / n^2.
void set_dither(FragmentOps& ops, int n, int frame_height);

}  // namespace tessera::detail
