// What shading says of a fragment.
#pragma once

#include <optional>

#include "linear.h"

namespace tessera::reference {

struct Shade {
  Vec4 color;  ///< 0..1
  std::optional<double>
      index;  ///< a palette index, continuous; if there is one it stands instead of the colour
};

}  // namespace tessera::reference
