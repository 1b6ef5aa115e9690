// Compares a picture with a reference.
#pragma once

#include <string>

#include "engine/program/imageio/picture.h"

namespace tessera::program::cli {

struct Difference {
  int largest = 0;         ///< largest difference of a component, in levels of 255
  std::size_t pixels = 0;  ///< pixels with a component that differs by more than the threshold
  double share = 0;        ///< fraction of all pixels
};

/// Compares red, green and blue.
/// @throws Error for pictures of different sizes
Difference compare(const Picture& picture, const Picture& reference, int threshold);

}  // namespace tessera::program::cli
