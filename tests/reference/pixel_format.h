// Conversion of colours and depths to stored levels, and of stored levels to displayed colours.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "palette.h"
#include "scene.h"

namespace tessera::reference {

/// Bits of R, G and B in a packed color R:G:B of 3 to 24 bits; plane 0 is the lowest bit of blue.
std::array<int, 3> split_bits(int color_bits);

/// Converts colours to packed colors and back for one frame buffer format. A packed color holds R:G:B,
/// luminance or index, and alpha above them.
class ColorFormat {
 public:
  explicit ColorFormat(const FrameBufferFormat& format);

  /// Packed color of a colour: levels of R:G:B, luminance (1 and 2 bits), or the nearest palette entry.
  /// @param color  clamped to 0..1 here.
  /// @param threshold  of ordered dither for all components including alpha, see dither_threshold(); 0.5
  ///     rounds.
  std::uint32_t word(Vec4 color, double threshold = 0.5) const;

  /// Packed color of an interpolated palette index: rounded, then masked to the buffer's bits.
  std::uint32_t index_word(double index) const;

  /// Colour read back from a packed color of an RGB buffer: red = green = blue for luminance, alpha 1 without
  /// alpha planes.
  Vec4 color(std::uint32_t word) const;

  /// Resolve: per component, the rounded mean of the samples' levels.
  std::uint32_t mean(std::span<const std::uint32_t> words) const;

  /// Displayed colour of a packed color; unset palette entries are black.
  Rgb8 shown(std::uint32_t word) const;

  /// Planes that a draw with these masks may change.
  std::uint32_t writable_planes(const std::array<bool, 4>& color_mask, std::uint32_t plane_mask) const;

 private:
  /// A bit field of the packed color.
  struct Field {
    int lowest = 0;
    int bits = 0;
  };

  std::uint32_t level(std::uint32_t word, Field field) const;

  FrameBufferFormat format_;
  NearestEntry nearest_;
  // Red, green, blue; or luminance or index; then alpha if present.
  std::vector<Field> fields_;
  std::size_t color_fields_ = 0;
};

/// A palette index right after lighting: integer part masked to the buffer's bits, fraction unchanged.
double masked_index(double index, int bits);

/// Stored level of a depth: floor(z (2^b - 1) + 0.5), or the bits of the nearest float; 0 without a depth
/// buffer. Levels of one format are ordered like their depths.
/// @param depth  0..1.
std::uint32_t depth_level(DepthFormat format, double depth);

}  // namespace tessera::reference
