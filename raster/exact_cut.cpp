#include "raster/exact_cut.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "raster/exact_sum.h"

namespace tessera {
namespace {

constexpr double ClipPosition::*kCoordinates[] = {&ClipPosition::x, &ClipPosition::y, &ClipPosition::z, &ClipPosition::w};

/// A vertex as it is before rounding, times a power of two.
struct ExactVertex {
  ExactSum coordinates[4];

  void set_up(const VertexTransform& t, const ClipVertex& v, int exponent) {
    for (std::size_t row = 0; row < 4; ++row) {
      if (!v.object) coordinates[row].add(std::scalbn(v.position.*kCoordinates[row], exponent));
      for (std::size_t column = 0; v.object && column < 4; ++column) coordinates[row].add_product(t.clip_from_object[4 * row + column], (*v.object)[column], exponent);
    }
  }
  /// From a plane, to the inside.
  void add_distance(ExactSum& sum, const VertexTransform& t, ClipCode plane) const {
    const auto &[x, y, z, w] = coordinates;
    switch (plane) {
      case kLeftOfGuardBand: sum.add_product(x, 1), sum.add_product(w, t.guard_x); break;
      case kRightOfGuardBand: sum.add_product(x, -1), sum.add_product(w, t.guard_x); break;
      case kBelowGuardBand: sum.add_product(y, 1), sum.add_product(w, t.guard_y); break;
      case kAboveGuardBand: sum.add_product(y, -1), sum.add_product(w, t.guard_y); break;
      case kBeforeNear: sum.add_product(z, t.reversed ? -1 : 1), sum.add_product(w, 1); break;
      case kBehindFar: sum.add_product(z, t.reversed ? 1 : -1), sum.add_product(w, t.reversed ? 0 : 1); break;
      default: break;
    }
  }
};

/// The ends of an edge, or the vertices of a triangle, scaled to about 1: products of some of them are well within a double's range.
template <std::size_t kCount>
struct ExactVertices {
  const std::array<const ClipVertex*, kCount> vertices;
  int exponent = 0;
  std::array<ExactVertex, kCount> exact;
  std::array<ExactSum, kCount> shares;

  ExactVertices(const VertexTransform& t, const std::array<const ClipVertex*, kCount>& v) : vertices(v) {
    double largest = 0;
    for (const ClipVertex* vertex : vertices)
      for (const auto coordinate : kCoordinates) largest = std::max(largest, std::abs(vertex->position.*coordinate));
    exponent = largest > 0 ? std::ilogb(largest) : 0;
    for (std::size_t k = 0; k < kCount; ++k) exact[k].set_up(t, *vertices[k], -exponent);
  }
  /// The sum of the vertices times their shares, over the sum of the shares.
  std::optional<ClipVertex> mix(int attribute_count) const {
    ExactSum sum_of_shares;
    for (const ExactSum& share : shares) sum_of_shares.add_product(share, 1);
    const double all = sum_of_shares.value();
    if (all == 0 || !std::isfinite(all)) return std::nullopt;
    ClipVertex mixed;
    for (std::size_t c = 0; c < 4; ++c) {
      ExactSum sum;
      for (std::size_t k = 0; k < kCount; ++k) sum.add_product(shares[k], exact[k].coordinates[c], 1);
      const double value = std::scalbn(sum.value() / all, exponent);
      if (!std::isfinite(value)) return std::nullopt;
      mixed.position.*kCoordinates[c] = value;
    }
    for (int j = 0; j < attribute_count; ++j) {
      double value = vertices[0]->attributes[j];
      for (std::size_t k = 1; k < kCount; ++k) value = std::fma(shares[k].value() / all, double{vertices[k]->attributes[j]} - vertices[0]->attributes[j], value);
      mixed.attributes[j] = static_cast<float>(value);
    }
    return mixed;
  }
};

}  // namespace

std::optional<ClipVertex> exact_cut(const VertexTransform& transform, ClipCode plane, const ClipVertex& a, const ClipVertex& b, int attribute_count) {
  ExactVertices<2> edge(transform, {&a, &b});
  ExactSum distances[2];
  for (std::size_t k = 0; k < 2; ++k) edge.exact[k].add_distance(distances[k], transform, plane);
  edge.shares[0].add_product(distances[1], 1);
  edge.shares[1].add_product(distances[0], -1);
  return edge.mix(attribute_count);
}

std::optional<ClipVertex> exact_crossing(const VertexTransform& transform, ClipCode plane, ClipCode other, const ClipVertex (&vertices)[3], int attribute_count) {
  ExactVertices<3> triangle(transform, {&vertices[0], &vertices[1], &vertices[2]});
  ExactSum on_plane[3], on_other[3];
  for (std::size_t k = 0; k < 3; ++k) {
    triangle.exact[k].add_distance(on_plane[k], transform, plane);
    triangle.exact[k].add_distance(on_other[k], transform, other);
  }
  for (std::size_t k = 0; k < 3; ++k) {  // weights of three distances whose sums are 0 for both planes: their cross product
    const std::size_t next = (k + 1) % 3, last = (k + 2) % 3;
    triangle.shares[k].add_product(on_plane[next], on_other[last], 1);
    triangle.shares[k].add_product(on_plane[last], on_other[next], -1);
  }
  return triangle.mix(attribute_count);
}

}  // namespace tessera
