// How a colour and a depth become the levels that a frame buffer stores, and what the stored levels show.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "palette.h"
#include "scene.h"

namespace tessera::reference {

/// Bits of R, G and B in a colour word R:G:B of 3 to 24 bits, plane 0 the lowest bit of blue.
std::array<int, 3> split_bits(int color_bits);

/// Colours to words and back for one frame buffer format. A word holds the bits of the colour, R:G:B,
/// luminance or index, and above them those of alpha.
class ColorFormat {
 public:
  explicit ColorFormat(const FrameBufferFormat& format);

  /// The word stored for a colour: levels of R:G:B, of the luminance (1 and 2 bits), or the nearest palette
  /// entry.
  /// @param color  clamped to 0..1 here.
  /// @param threshold  of ordered dither, see dither_threshold(); 0.5 rounds. All components obey it, alpha
  /// too.
  std::uint32_t word(Vec4 color, double threshold = 0.5) const;

  /// The word stored for a palette index as it comes from interpolation: rounded, then masked to the buffer's
  /// bits.
  std::uint32_t index_word(double index) const;

  /// What is read back from a stored word of an RGB buffer: red = green = blue if it holds luminance, alpha 1
  /// without alpha planes.
  Vec4 color(std::uint32_t word) const;

  /// The word that is shown for a pixel of several samples: the mean of each component's levels, rounded.
  std::uint32_t mean(std::span<const std::uint32_t> words) const;

  /// What a stored word shows; palette entries that are not set show black.
  Rgb8 shown(std::uint32_t word) const;

  /// The planes that a draw with these masks may change.
  std::uint32_t writable_planes(const std::array<bool, 4>& color_mask, std::uint32_t plane_mask) const;

 private:
  /// A run of bits in the word.
  struct Field {
    int lowest = 0;
    int bits = 0;
  };

  std::uint32_t level(std::uint32_t word, Field field) const;

  FrameBufferFormat format_;
  NearestEntry nearest_;
  std::vector<Field>
      fields_;  // red, green, blue, or the luminance or index alone; then alpha, if there is any
  std::size_t color_fields_ = 0;
};

/// A palette index right after lighting: its integer part masked to the buffer's bits, its fraction left
/// alone.
double masked_index(double index, int bits);

/// The level stored for a depth: floor(z (2^b - 1) + 0.5), or the bits of the nearest float; 0 without a
/// depth buffer.
/// @param depth  0..1. Levels of one format compare as their depths do.
std::uint32_t depth_level(DepthFormat format, double depth);

}  // namespace tessera::reference
