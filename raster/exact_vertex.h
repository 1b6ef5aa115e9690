// Exact clip-space coordinates of a vertex.
#pragma once

#include <array>

#include "raster/exact_sum.h"
#include "raster/vertex_transform.h"

namespace tessera::detail {

class ExactVertex {
 public:
  ExactVertex() = default;
  /// The transform of a mesh vertex, times 2^exponent.
  ExactVertex(const VertexTransform& transform, const std::array<float, 4>& object, int exponent);
  /// A clip-space position, times 2^exponent.
  ExactVertex(const ClipPosition& position, int exponent);

  /// @param i  0 to 3: x, y, z, w
  const ExactSum& coordinate(std::size_t i) const { return coordinates_[i]; }
  /// Signed distance from a plane, up to scale; negative outside.
  ExactSum distance(const VertexTransform& transform, Outcode plane) const;
  /// Rounded coordinates; relative error of each below 2^-52.
  ClipPosition position() const;
  /// The outcode of compute_outcode(), from exact distances.
  std::uint8_t outcode(const VertexTransform& transform) const;

 private:
  ExactSum coordinates_[4];
};

}  // namespace tessera::detail
