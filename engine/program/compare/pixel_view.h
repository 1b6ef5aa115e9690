// Pictures in the caller's memory, as comparisons read them.
#pragma once

#include <cstddef>
#include <cstdint>

#include "engine/program/imageio/picture.h"

namespace tessera::program {

/// Pixels of 8 bits per component, red, green and blue first; rows from the top without gaps.
/// - Does not own the pixels.
struct PixelView {
  const std::uint8_t* pixels = nullptr;
  int width = 0, height = 0;  ///< pixels, at least 1
  int pixel_bytes = 4;        ///< 3 or more; bytes after the third are ignored

  std::size_t pixel_count() const {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  }
  const std::uint8_t* pixel(int x, int y) const {
    return pixels +
           (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)) *
               static_cast<std::size_t>(pixel_bytes);
  }
};

inline PixelView pixels_of(const Picture& picture) {
  return {.pixels = picture.rgba.data(), .width = picture.width, .height = picture.height};
}

/// @throws Error, naming both sizes, unless they are the same
void require_same_size(const PixelView& picture, const PixelView& reference);

}  // namespace tessera::program
