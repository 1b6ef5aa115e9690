// Result of shading a fragment.
#pragma once

#include <optional>

#include "linear.h"

namespace tessera::reference {

struct Shade {
  Vec4 color;  ///< 0..1
  /// A continuous palette index; replaces the colour if present.
  std::optional<double> index;
};

}  // namespace tessera::reference
