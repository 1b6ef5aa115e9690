// Bounds of vectors of vertices.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "framebuffer/instruction_set.h"
#include "raster/vertex_transform.h"

namespace tessera::detail {

struct FloatBox {
  std::array<float, 3> low{}, high{};

  void include(const FloatBox& other) {
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], other.low[k]);
      high[k] = std::max(high[k], other.high[k]);
    }
  }
};

/// Finds the bounds of the first three floats of `count` records, one or more.
/// @return  false if a value is not finite; `box` is then undefined
using FindBounds = bool(StridedFloats values, std::size_t count, FloatBox& box);
FindBounds* find_bounds(InstructionSet isa);

/// Scalar twin of find_bounds().
inline bool find_bounds_reference(StridedFloats values, std::size_t count, FloatBox& box) {
  bool is_finite = true;
  for (std::size_t i = 0; i < count; ++i) {
    const float* const value = values.at(i);
    const FloatBox point{{value[0], value[1], value[2]}, {value[0], value[1], value[2]}};
    if (i == 0) box = point;
    box.include(point);
    is_finite &= std::isfinite(value[0]) && std::isfinite(value[1]) && std::isfinite(value[2]);
  }
  return is_finite;
}

}  // namespace tessera::detail
