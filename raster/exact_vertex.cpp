#include "raster/exact_vertex.h"

#include <cmath>

namespace tessera::detail {

ExactVertex::ExactVertex(const VertexTransform& t, const std::array<float, 4>& object, int exponent) {
  for (std::size_t row = 0; row < 4; ++row)
    for (std::size_t column = 0; column < 4; ++column)
      coordinates_[row].add_product(t.clip_from_object[4 * row + column], object[column], exponent);
}

ExactVertex::ExactVertex(const ClipPosition& position, int exponent) {
  const double given[] = {position.x, position.y, position.z, position.w};
  for (std::size_t row = 0; row < 4; ++row) coordinates_[row].add(std::scalbn(given[row], exponent));
}

ExactSum ExactVertex::distance(const VertexTransform& t, Outcode plane) const {
  const auto& [x, y, z, w] = coordinates_;
  ExactSum sum;
  const auto add = [&](const ExactSum& coordinate, double sign, double factor_of_w) {
    sum.add_product(coordinate, sign);
    sum.add_product(w, factor_of_w);
  };
  switch (plane) {
    case kLeftOfGuardBand: add(x, 1, t.guard_x); break;
    case kRightOfGuardBand: add(x, -1, t.guard_x); break;
    case kBelowGuardBand: add(y, 1, t.guard_y); break;
    case kAboveGuardBand: add(y, -1, t.guard_y); break;
    case kBeforeNear: add(z, t.reversed ? -1 : 1, 1); break;
    case kBehindFar: add(z, t.reversed ? 1 : -1, t.reversed ? 0 : 1); break;
    default: sum.add_product(w, 1); break;
  }
  return sum;
}

ClipPosition ExactVertex::position() const {
  return {coordinates_[0].value(), coordinates_[1].value(), coordinates_[2].value(), coordinates_[3].value()};
}

std::uint8_t ExactVertex::outcode(const VertexTransform& t) const {
  std::uint8_t outcode = coordinates_[3].value() > 0 ? 0 : kNonPositiveW;
  for (const Outcode plane :
       {kLeftOfGuardBand, kRightOfGuardBand, kBelowGuardBand, kAboveGuardBand, kBeforeNear, kBehindFar})
    if (distance(t, plane).value() < 0) outcode |= plane;
  return outcode;
}

}  // namespace tessera::detail
