// The reference renderer: a whole scene, one pixel at a time, in double precision.
#pragma once

#include <cstdint>
#include <vector>

#include "accumulation.h"
#include "scene.h"

namespace tessera::reference {

/// What a frame leaves in the buffers. Every vector has width_px * height_px elements (rgb three times as
/// many), top row first. Of several samples words are their mean, depth and stencil those of sample 0.
struct Picture {
  int width_px = 0;
  int height_px = 0;
  /// Stored colour: levels A:R:G:B (bit k is plane k), luminance level below alpha, or palette index.
  std::vector<std::uint32_t> words;
  std::vector<std::uint8_t> rgb;  ///< what the words show, 8 bits a component
  std::vector<double>
      depth;  ///< of the fragment stored last, before rounding to a level; 1 without a depth buffer
  std::vector<std::uint32_t>
      depth_levels;  ///< stored depth: unorm level, or the bits of the float; 0 without a depth buffer
  std::vector<std::uint8_t> stencil;  ///< 0 without a stencil buffer
  std::vector<AccumPixel>
      accumulation;  ///< levels of red, green, blue, alpha; empty without an accumulation buffer
  std::vector<std::uint32_t>
      sample_words;  ///< the word of each sample, those of a pixel side by side: `samples` times as many
  std::vector<std::int32_t> draws;       ///< index in Scene::frame of the draw that wrote any sample's colour
                                         ///< last, -1: none since the clear
  std::vector<std::int32_t> primitives;  ///< and which primitive of its mesh; -1 for the background

  std::size_t pixel(int x, int row_from_top) const {
    return static_cast<std::size_t>(row_from_top) * static_cast<std::size_t>(width_px) +
           static_cast<std::size_t>(x);
  }
};

/// @param scene  as load_scene() and parse_scene() make it: they refuse what cannot be drawn.
Picture render(const Scene& scene);

}  // namespace tessera::reference
