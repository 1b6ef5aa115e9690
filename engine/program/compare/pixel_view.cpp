#include "engine/program/compare/pixel_view.h"

#include <string>

namespace tessera::program {

void require_same_size(const PixelView& picture, const PixelView& reference) {
  const auto size_of = [](const PixelView& view) {
    return std::to_string(view.width) + "x" + std::to_string(view.height);
  };
  if (picture.width != reference.width || picture.height != reference.height)
    throw Error("the picture is " + size_of(picture) + ", the reference " + size_of(reference) +
                "; both must have the same size");
}

}  // namespace tessera::program
