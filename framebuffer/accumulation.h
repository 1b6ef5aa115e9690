// Arithmetic of the accumulation buffer [GL 2.1, 4.2.4]: signed components of 16 or 32 bits. 1.0 is the
// largest level, 32767 or 2^31 - 1. Results outside the range saturate.
//
// With the operation's value v, a colour component c of 0..1 and the level S of 1.0: a stored component is an
// integer, so acc + floor(v c S + 0.5) equals acc + v c S rounded once. The added term depends on the stored
// colour level alone: the terms are tabulated, one per level.
#pragma once

#include <array>
#include <cstdint>

#include "framebuffer/color_dither.h"
#include "framebuffer/format.h"
#include "framebuffer/tessera/enums.hpp"

namespace tessera::detail {

inline constexpr int kMaxLevels = 256;  ///< levels of a stored colour component of 8 bits

/// Levels of one pixel: red, green, blue, alpha.
using AccumulatedPixel = std::array<std::int32_t, 4>;
/// Pointers to the levels of many pixels: red, green, blue, alpha.
using AccumulatedPixels = std::array<std::int32_t*, 4>;

/// The level of 1.0. @param bits  bits of a component: 16 or 32, here and below
constexpr double accumulation_one(int bits) { return bits == 16 ? 32767.0 : 2147483647.0; }
/// Nearest level of `value`, halves up, saturated. Infinities are allowed, NaN is not.
std::int32_t accumulation_level(double value, int bits);
/// Sign-extends a component read from the planes.
constexpr std::int32_t accumulation_level_from_stored(std::uint32_t word, int bits) {
  return bits == 16 ? static_cast<std::int16_t>(word) : static_cast<std::int32_t>(word);
}

/// One accumulation operation, prepared for many pixels.
class Accumulation {
 public:
  /// @param value   finite
  /// @param layout  colour buffer: RGB, or luminance (its grey counts as red, green and blue). Without alpha
  ///                planes alpha is 1.
  Accumulation(AccumOp op, double value, int bits, const ColorLayout& layout);

  AccumOp op() const { return op_; }
  /// Updates the levels of `count` pixels. @pre op() is not return_color
  /// @param packed_colors  packed colours of these pixels; read by accum and load only
  void run(const std::uint32_t* packed_colors, const AccumulatedPixels& levels, int count) const;
  /// Packed colour that return_color writes at a pixel, rows from the top: each component is
  /// floor(c (2^b - 1) + threshold), in light after ColorDither::component().
  /// @param dither  null: none
  std::uint32_t packed_color(const AccumulatedPixel& levels, const ColorDither* dither, int x, int y) const;

 private:
  // Terms added to a component, clamped to twice the range of 32 bits, which saturates from any level.
  using Terms = std::array<std::int64_t, kMaxLevels>;
  struct Field {
    int shift = 0;  ///< lowest bit in the packed colour
    int bits = 0;   ///< 0: the component is absent and reads as 1
  };
  template <bool kAccumulates>
  void add_colors(const std::uint32_t* packed_colors, const AccumulatedPixels& levels, int count) const;

  AccumOp op_;
  double value_;
  int bits_;
  ColorLayout layout_;
  std::array<Field, 4> fields_;
  std::array<Terms, 4> terms_;  ///< accum, load: indexed by the stored component's level; add: element 0
};

}  // namespace tessera::detail
