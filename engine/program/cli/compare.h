// Is a picture that of a file?
#pragma once

#include <string>

#include "engine/program/imageio/picture.h"

namespace tessera::program::cli {

struct Difference {
  int largest = 0;         ///< of all components, in levels of 255
  std::size_t pixels = 0;  ///< with a component further apart than the threshold
  double share = 0;        ///< of all pixels
};

/// @throws Error for pictures of different sizes
Difference compare(const Picture& picture, const Picture& reference, int threshold);

}  // namespace tessera::program::cli
