// A vertex in clip space without rounding.
#pragma once

#include <array>

#include "raster/exact_sum.h"
#include "raster/vertex_transform.h"

namespace tessera::detail {

class ExactVertex {
 public:
  ExactVertex() = default;
  /// A mesh's own vertex, times 2^exponent.
  ExactVertex(const VertexTransform& transform, const std::array<float, 4>& object, int exponent);
  /// A position as it is, times 2^exponent.
  ExactVertex(const ClipPosition& position, int exponent);

  const ExactSum& coordinate(std::size_t i) const { return coordinates_[i]; }  ///< x y z w
  /// How far inside of a plane it lies; negative outside.
  ExactSum distance(const VertexTransform& transform, Outcode plane) const;
  /// Each coordinate off by 2^-52 of itself.
  ClipPosition position() const;
  /// As compute_outcode() has it.
  std::uint8_t outcode(const VertexTransform& transform) const;

 private:
  ExactSum coordinates_[4];
};

}  // namespace tessera::detail
