// What shading needs of a triangle that was seen in a tile.
#pragma once

#include <cstdint>

#include "raster/triangle_setup.h"

namespace tessera::detail {

/// A vertex's weight at a pixel is its barycentric coordinate times its 1/w, up to a common factor. It comes
/// from the exact integer edge opposite the vertex, rounded once: slivers lose nothing, and a w ratio of 10^6
/// cancels nothing.
struct ShadedTriangle {
  Edges32 edges;             ///< narrow triangles: the exact edges
  float scale[3], shift[3];  ///< weight_k = scale_k E_k + shift_k; wide: scale_k times the exact double edge
  std::int32_t edges64_index = -1;  ///< number of its Edges64; -1: narrow
  bool affine = false;  ///< all 1/w are the same: the weights are the barycentric coordinates themselves
  bool back = false;
  std::uint32_t draw = 0;
  const float* attributes[3] = {};  ///< behind those of each kAttributePadding more may be read
};

/// Attributes of a triangle that many blocks need: at vertex 0, and from there to the others.
struct alignas(32) TriangleInterpolants {
  static constexpr int kCapacity = 8;
  float first[kCapacity], to_second[kCapacity], to_third[kCapacity];
};

}  // namespace tessera::detail
