// How a colour and a depth become the levels that a frame buffer stores, and what the stored levels show.
#pragma once

#include <array>
#include <cstdint>

#include "palette.h"
#include "scene.h"

namespace tessera::reference {

/// Bits of R, G and B in a colour word R:G:B of 3 to 24 bits, plane 0 the lowest bit of blue.
std::array<int, 3> split_bits(int color_bits);

/// Colours to words and back for one frame buffer format.
class ColorFormat {
 public:
  explicit ColorFormat(const FrameBufferFormat& format);

  /// The word stored for a colour: levels of R:G:B, of the luminance (1 and 2 bits), or the nearest palette entry.
  /// @param color  clamped to 0..1 here.
  std::uint32_t word(Vec4 color) const;

  /// What a stored word shows; palette entries that are not set show black.
  Rgb8 shown(std::uint32_t word) const;

  /// The planes that a draw with these masks may change.
  std::uint32_t writable_planes(const std::array<bool, 4>& color_mask, std::uint32_t plane_mask) const;

 private:
  FrameBufferFormat format_;
  NearestEntry nearest_;
};

/// The level stored for a depth: floor(z (2^b - 1) + 0.5), or the bits of the nearest float; 0 without a depth buffer.
/// @param depth  0..1. Levels of one format compare as their depths do.
std::uint32_t depth_level(DepthFormat format, double depth);

}  // namespace tessera::reference
