// The record of a triangle that shading reads.
#pragma once

#include <cstdint>

#include "raster/triangle_setup.h"

namespace tessera::detail {

/// The weight of a vertex at a pixel is its barycentric coordinate times its 1/w, up to a common factor. It
/// is computed from the exact integer edge opposite the vertex and rounded once, so slivers and w ratios of
/// 10^6 lose nothing.
struct ShadedTriangle {
  Edges32 edges;             ///< narrow triangles: exact edges
  float scale[3], shift[3];  ///< weight_k = scale_k E_k + shift_k; wide: scale_k times the exact double edge
  std::int32_t edges64_index = -1;  ///< wide: index of its Edges64; -1: narrow
  bool affine = false;              ///< all 1/w are equal: weights are barycentric coordinates
  bool back = false;
  std::uint32_t draw = 0;
  const float* attributes[3] = {};  ///< kAttributePadding floats after each vertex's are readable
};

/// Attributes of a triangle that many blocks use: at vertex 0, and the differences of the others.
struct alignas(32) TriangleInterpolants {
  static constexpr int kCapacity = 8;
  float first[kCapacity], to_second[kCapacity], to_third[kCapacity];
};

}  // namespace tessera::detail
