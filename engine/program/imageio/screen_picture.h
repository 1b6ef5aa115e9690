// The picture of a frame buffer as files of indexed pixels hold it: indices and a palette, or RGB.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/tessera/display_mode.hpp"
#include "engine/tessera/tessera.hpp"

namespace tessera::program {

struct ScreenPicture {
  int width = 0, height = 0;  ///< pixels
  AspectRatio pixel_aspect{};
  int bits = 24;                      ///< per pixel: 1 to 8 for indices, 24 for RGB
  std::vector<std::uint32_t> pixels;  ///< indices, or red << 16 | green << 8 | blue; rows from the top
  std::vector<std::array<std::uint8_t, 3>> palette;  ///< 2^bits entries; empty for RGB

  std::uint32_t pixel(int x, int y) const {
    return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(x)];
  }
};

/// Reads the stored picture.
/// - Palette frames of up to 8 bits and grey frames of up to 2 become indices; entries that the frame
/// buffer's
///   palette lacks are black. All others become RGB, as a display shows them.
/// @throws Error if the last frame did not keep the colours
ScreenPicture screen_picture(const FrameBuffer& buffer, AspectRatio pixel_aspect);

}  // namespace tessera::program
