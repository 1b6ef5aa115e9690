// The record of a triangle that shading reads.
#pragma once

#include <cstdint>

#include "raster/triangle_setup.h"

namespace tessera::detail {

/// The weight of a vertex at a pixel is its barycentric coordinate times its 1/w, up to a common factor. It
/// is computed from the exact integer edge opposite the vertex and rounded once, so slivers and w ratios of
/// 10^6 lose nothing.
struct ShadedTriangle {
  Edges32 edges;  ///< narrow triangles: exact edges
  /// Narrow: weight_k = scale_k E_k + shift_k, with E_k from `edges`. Wide: weight_k = scale_k E_k, with E_k
  /// the exact edge in double.
  float scale[3], shift[3];
  std::int32_t edges64_index = -1;  ///< wide: index of its Edges64; -1: narrow
  bool affine = false;              ///< all 1/w are equal: weights are barycentric coordinates
  bool back = false;
  std::uint32_t draw = 0;
  const float* attributes[3] = {};  ///< per vertex; kAttributePadding floats after the last are readable
};

/// Attributes of a triangle, shared by its blocks: values at vertex 0, and differences of vertices 1 and 2.
struct alignas(32) TriangleInterpolants {
  static constexpr int kCapacity = 8;
  float first[kCapacity], to_second[kCapacity], to_third[kCapacity];
};

}  // namespace tessera::detail
