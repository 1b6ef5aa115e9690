// Commands of a frame other than meshes: bitmaps, images, clears, accumulation; and captures.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include <tessera/enums.hpp>

#include "types.hpp"

namespace tessera {

/// A bit pattern in one colour; 0 bits leave pixels unchanged.
/// Rows from the top, bit 7 of a byte is the leftmost pixel. Borrowed until the frame is finished or reset.
struct Bitmap {
  const std::uint8_t* bits = nullptr;
  int width = 0, height = 0;        ///< pixels, 1 to kMaxFrameBufferSize
  std::ptrdiff_t stride_bytes = 0;  ///< from a row to the one below; 0: (width + 7) / 8
  double x = 0, y = 0;              ///< lower left corner, window coordinates, rounded down
  double depth = 0;                 ///< window depth, 0 to 1
  Color color{1, 1, 1, 1};
};

/// Pixels of 8 bits per component, rows from the top. Borrowed until the frame is finished or reset.
/// Texel (i, j), counted from the lower left, covers the pixels whose centres lie from
/// (x + i zoom_x, y + j zoom_y), inclusive, to the start of the next texel.
struct PixelImage {
  const std::uint8_t* pixels = nullptr;
  int width = 0, height = 0;        ///< texels, 1 to kMaxFrameBufferSize
  int channels = 4;                 ///< 1: grey; 2: grey, alpha; 3: r g b; 4: r g b a
  std::ptrdiff_t stride_bytes = 0;  ///< from a row to the one below; 0: width * channels
  double x = 0, y = 0;              ///< corner of texel (0, 0), window coordinates
  double zoom_x = 1, zoom_y = 1;    ///< pixels per texel; negative: leftwards, downwards; 0: nothing is drawn
  double depth = 0;                 ///< window depth, 0 to 1
};

/// Clears the buffers that are given a value. Ignores masks; colours are dithered like draws.
struct Clear {
  /// Components 0 to 1. Colour-index buffers: the nearest palette entry, unless `index` is set.
  std::optional<Color> color{};
  std::optional<std::uint32_t> index{};    ///< colour-index buffers only: below 2^color_bits
  std::optional<double> depth{};           ///< 0 to 1
  std::optional<std::uint32_t> stencil{};  ///< below 2^stencil_bits
  std::optional<Color> accumulation{};     ///< components -1 to 1
  std::optional<Rect> scissor{};           ///< absent: whole buffer
};

/// An operation between the colour and the accumulation buffer. Results are clamped to -1 to 1.
/// Buffers without alpha planes read alpha 1; luminance buffers read grey as r, g and b.
struct Accum {
  AccumOp op = AccumOp::accum;
  double value = 1;                                        ///< any finite number
  std::optional<Rect> scissor{};                           ///< absent: whole buffer
  std::array<bool, 4> color_mask{true, true, true, true};  ///< return_color: r g b a that may change
};

/// Per-pixel data that finish() writes next to the picture, for picking and for tools.
/// - Rows from the top, the pixels of `region`. Borrowed until the frame is finished or reset.
/// - Cost: one more pass over the tiles of the region per non-empty span.
/// - MSAA buffers: evaluated at pixel centres; points and lines as with one sample.
/// - Where draws are blended, the last one that passed the tests counts. Accumulation is ignored.
struct Capture {
  static constexpr std::uint32_t kNothing = 0xffffffffu;  ///< no draw gave this pixel its colour

  /// Number of the draw in the frame, from 0; bitmaps and images count as draws.
  std::span<std::uint32_t> draw_ids{};
  /// Number of the primitive in its mesh, from 0; 0 for bitmaps and images.
  std::span<std::uint32_t> primitive_ids{};
  /// x y z per pixel: the interpolated normal, eye space, length 1.
  /// - Meshes without normals: means of the face normals.
  /// - 0 0 0 for background, bitmaps and images, and where normals cancel.
  std::span<float> normals{};
  /// The pixels that are captured, down to one; must lie in the frame buffer. Absent: all.
  std::optional<Rect> region{};
};

}  // namespace tessera
