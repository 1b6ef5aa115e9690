// The arithmetic of the accumulation buffer [GL 2.1, 4.2.4]: signed components of 16 or 32 bits, where 1.0 is
// the largest level, 32767 or 2^31 - 1. What leaves the range stays at its end.
//
// A stored component is an integer, so acc + floor(v c S + 0.5) is acc + v c rounded once: what a command
// adds depends on the level of the colour alone, and is worked out once for each level.
#pragma once

#include <array>
#include <cstdint>

#include "framebuffer/format.h"
#include "framebuffer/tessera/enums.hpp"

namespace tessera::detail {

inline constexpr int kMaxLevels = 256;  ///< of a stored colour component

/// Levels of red, green, blue, alpha: of one pixel, or where those of many start.
using AccumulatedPixel = std::array<std::int32_t, 4>;
using AccumulatedPixels = std::array<std::int32_t*, 4>;

/// 1.0 as a level. @param bits  16 or 32, as in all that follows
constexpr double accumulation_one(int bits) { return bits == 16 ? 32767.0 : 2147483647.0; }
/// The nearest level, halves up, at the ends of the range where it lies outside. Infinities are fine, NaN is
/// not.
std::int32_t accumulation_level(double value, int bits);
/// A stored word with its sign.
constexpr std::int32_t accumulation_level_from_stored(std::uint32_t word, int bits) {
  return bits == 16 ? static_cast<std::int16_t>(word) : static_cast<std::int32_t>(word);
}

/// One command, ready to run on many pixels.
class Accumulation {
 public:
  /// @param value   finite
  /// @param layout  of the colour buffer: RGB or luminance, whose grey counts as red, green and blue; without
  /// alpha planes alpha is 1.
  Accumulation(AccumOp op, double value, int bits, const ColorLayout& layout);

  AccumOp op() const { return op_; }
  /// Changes the levels of `count` pixels. Not for give_back.
  /// @param packed_colors  packed colours of these pixels; read by accumulate and load alone
  void run(const std::uint32_t* packed_colors, const AccumulatedPixels& levels, int count) const;
  /// The colour word of give_back: each component floor(c (2^b - 1) + threshold).
  std::uint32_t packed_color(const AccumulatedPixel& levels, double threshold) const;

 private:
  // What is added to a component; at most twice the range, which leaves it from anywhere.
  using Terms = std::array<std::int64_t, kMaxLevels>;
  struct Field {
    int shift = 0, bits = 0;  ///< in the colour word; no bits: always 1
  };
  template <bool kAccumulates>
  void add_colors(const std::uint32_t* packed_colors, const AccumulatedPixels& levels, int count) const;

  AccumOp op_;
  double value_;
  int bits_;
  ColorLayout layout_;
  std::array<Field, 4> fields_;
  std::array<Terms, 4> terms_;  ///< accumulate, load: by the component's level; add: the first
};

}  // namespace tessera::detail
