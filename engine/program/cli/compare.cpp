#include "engine/program/cli/compare.h"

#include <algorithm>
#include <cstdlib>

namespace tessera::program::cli {

Difference compare(const Picture& picture, const Picture& reference, int threshold) {
  if (picture.width != reference.width || picture.height != reference.height)
    throw Error("the picture is " + std::to_string(picture.width) + "x" + std::to_string(picture.height) +
                ", the reference " + std::to_string(reference.width) + "x" +
                std::to_string(reference.height) + "; both must have the same size");
  Difference difference;
  for (std::size_t i = 0; i < picture.rgba.size(); i += 4) {
    int distance = 0;
    for (std::size_t c = 0; c < 3; ++c)
      distance = std::max(distance, std::abs(int{picture.rgba[i + c]} - int{reference.rgba[i + c]}));
    difference.largest = std::max(difference.largest, distance);
    difference.pixels += distance > threshold ? 1 : 0;
  }
  difference.share =
      static_cast<double>(difference.pixels) / (static_cast<double>(picture.width) * picture.height);
  return difference;
}

}  // namespace tessera::program::cli
