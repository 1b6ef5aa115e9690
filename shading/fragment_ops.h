// What happens to a fragment on its way into the frame buffer: alpha test, stencil, depth, blend, dither,
// logic operation, masks, in this order [GL 2.1, 4.1]. Draws that have none of it never come here.
#pragma once

#include <array>
#include <cstdint>

namespace tessera {

/// 0..7 in the order never less equal lequal greater notequal gequal always.
enum class CompareOp : std::uint8_t { never, less, equal, lequal, greater, notequal, gequal, always };

enum class StencilAction : std::uint8_t { keep, zero, replace, incr, decr, invert, incr_wrap, decr_wrap };

/// Passes where (reference & mask) func (stored & mask).
struct StencilSide {
  CompareOp func = CompareOp::always;
  std::int32_t reference = 0;  ///< cut to the buffer's bits
  std::int32_t mask = 0xff;
  StencilAction fail = StencilAction::keep, zfail = StencilAction::keep, zpass = StencilAction::keep;
  std::int32_t write_mask = 0xff;

  constexpr bool writes() const {
    return write_mask != 0 &&
           (fail != StencilAction::keep || zfail != StencilAction::keep || zpass != StencilAction::keep);
  }
};

enum class Factor : std::uint8_t {
  zero,
  one,
  src_color,
  one_minus_src_color,
  dst_color,
  one_minus_dst_color,
  src_alpha,
  one_minus_src_alpha,
  dst_alpha,
  one_minus_dst_alpha,
  constant_color,
  one_minus_constant_color,
  constant_alpha,
  one_minus_constant_alpha,
  src_alpha_saturate
};
enum class Equation : std::uint8_t { add, subtract, reverse_subtract, min, max };

/// OpenGL's sixteen, in its order.
enum class Logic : std::uint8_t {
  clear,
  and_,
  and_reverse,
  copy,
  and_inverted,
  noop,
  xor_,
  or_,
  nor,
  equiv,
  invert,
  or_reverse,
  copy_inverted,
  or_inverted,
  nand,
  set
};

inline constexpr int kDitherSize = 8;  ///< patterns repeat after so many pixels at most

struct FragmentOps {
  bool alpha_test = false;
  CompareOp alpha_func = CompareOp::greater;
  float alpha_reference = 0.5f;

  bool stencil = false;
  StencilSide faces[2];              ///< front, back
  std::int32_t stencil_max = 0xff;  ///< 2^bits - 1

  bool blend = false;
  Factor src_color = Factor::src_alpha, dst_color = Factor::one_minus_src_alpha,
         src_alpha = Factor::src_alpha, dst_alpha = Factor::one_minus_src_alpha;
  Equation equation = Equation::add;
  std::array<float, 4> constant{};  ///< 0..1

  bool dither = false;
  /// What is added before a level is cut off, by raster row and column; without dither 0.5 everywhere.
  float threshold[kDitherSize][kDitherSize] = {};
  float palette_spread = 0;  ///< index buffers: how far (threshold - 0.5) moves the colour that is looked up

  Logic logic = Logic::copy;
};

/// The thresholds of ordered dither of size n (2, 4, 8; 1: none): M_1 = [0], M_2n = [[4 M_n, 4 M_n + 2], [4
/// M_n + 3, 4 M_n + 1]], rows from the window's lower edge, (M[y mod n][x mod n] + 0.5) / n^2.
void set_dither(FragmentOps& ops, int n, int frame_height);

}  // namespace tessera
