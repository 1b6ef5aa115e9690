// The reference renderer: renders a scene one pixel at a time in double precision.
#pragma once

#include <cstdint>
#include <vector>

#include "accumulation.h"
#include "scene.h"
#include "window.h"

namespace tessera::reference {

/// Buffer contents after a frame. Every vector has width_px * height_px elements (rgb three times as many),
/// top row first. With several samples words are the resolved mean, depth and stencil those of sample 0.
struct Picture {
  int width_px = 0;
  int height_px = 0;
  /// Stored colour: levels A:R:G:B (bit k is plane k), luminance level below alpha, or palette index.
  std::vector<std::uint32_t> words;
  std::vector<std::uint8_t> rgb;  ///< displayed colours, 8 bits per component
  /// Colours 0..1 before rounding to levels and before dither, the mean of a pixel's samples; blending uses
  /// unrounded destinations. RGB buffers only; unspecified after accumulation operations other than return.
  std::vector<Vec4> unrounded;
  /// Depth of the last stored fragment, before rounding to a level; 1 without a depth buffer.
  std::vector<double> depth;
  /// Stored depth: unorm level, or the bits of the float; 0 without a depth buffer.
  std::vector<std::uint32_t> depth_levels;
  std::vector<std::uint8_t> stencil;  ///< 0 without a stencil buffer
  /// Levels of red, green, blue, alpha; empty without an accumulation buffer.
  std::vector<AccumPixel> accumulation;
  /// Packed color of each sample, `samples` per pixel, adjacent.
  std::vector<std::uint32_t> sample_words;
  /// Index in Scene::frame of the draw that last wrote the colour of any sample; -1 for none since the clear.
  std::vector<std::int32_t> draws;
  std::vector<std::int32_t> primitives;  ///< primitive of that draw's mesh; -1 for the background

  std::size_t pixel(int x, int row_from_top) const {
    return static_cast<std::size_t>(row_from_top) * static_cast<std::size_t>(width_px) +
           static_cast<std::size_t>(x);
  }
};

/// @param scene  as returned by load_scene() and parse_scene(), which reject invalid scenes.
/// @param sample_shift  moves the sample positions of all pixels, in 1/256 pixel. Vertices are snapped first,
///     so the pictures of several shifts sample the same primitives. Bitmaps and images are not shifted.
Picture render(const Scene& scene, Point sample_shift = {});

}  // namespace tessera::reference
