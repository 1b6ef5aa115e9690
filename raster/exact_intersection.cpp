#include "raster/exact_intersection.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "raster/exact_vertex.h"

namespace tessera::detail {
namespace {

constexpr double ClipPosition::*kCoordinates[] = {&ClipPosition::x, &ClipPosition::y, &ClipPosition::z,
                                                  &ClipPosition::w};
// Corners made by cuts are classified by their rounded positions, so an intersection may lie outside its
// triangle by that rounding. Barycentric weights down to -kMaxOvershoot are accepted.
constexpr double kMaxOvershoot = 0x1p-20;

/// Exact positions of an edge's ends or a triangle's vertices, scaled to about 1 so that their products stay
/// well within the range of doubles.
template <std::size_t kCount>
struct ExactVertices {
  const std::array<const ClipVertex*, kCount> vertices;
  int exponent = 0;
  std::array<ExactVertex, kCount> exact;
  std::array<ExactSum, kCount> weights;

  ExactVertices(const VertexTransform& t, const std::array<const ClipVertex*, kCount>& v) : vertices(v) {
    double largest = 0;
    for (const ClipVertex* vertex : vertices)
      for (const auto coordinate : kCoordinates)
        largest = std::max(largest, std::abs(vertex->position.*coordinate));
    exponent = largest > 0 ? std::ilogb(largest) : 0;
    for (std::size_t k = 0; k < kCount; ++k) {
      const ClipVertex& vertex = *vertices[k];
      exact[k] = vertex.object ? ExactVertex(t, *vertex.object, vertex.object_exponent - exponent)
                               : ExactVertex(vertex.position, -exponent);
    }
  }
  /// Sum of weight times vertex over the sum of the weights. Absent if the point does not lie between the
  /// vertices.
  std::optional<ClipVertex> interpolate(int attribute_count) const {
    ExactSum weight_sum;
    for (const ExactSum& weight : weights) weight_sum.add_product(weight, 1);
    const double divisor = weight_sum.value();
    if (divisor == 0 || !std::isfinite(divisor)) return std::nullopt;
    double normalized[kCount];
    for (std::size_t k = 0; k < kCount; ++k) {
      normalized[k] = weights[k].value() / divisor;
      if (!(normalized[k] >= -kMaxOvershoot)) return std::nullopt;
    }
    ClipVertex interpolated;
    for (std::size_t c = 0; c < 4; ++c) {
      ExactSum sum;
      for (std::size_t k = 0; k < kCount; ++k) sum.add_product(weights[k], exact[k].coordinate(c), 1);
      const double value = std::scalbn(sum.value() / divisor, exponent);
      if (!std::isfinite(value)) return std::nullopt;
      interpolated.position.*kCoordinates[c] = value;
    }
    for (int j = 0; j < attribute_count; ++j) {
      const float first = vertices[0]->attributes[j];
      float low = first, high = first;
      double value = first;
      for (std::size_t k = 1; k < kCount; ++k) {
        const float at = vertices[k]->attributes[j];
        value = std::fma(normalized[k], double{at} - first, value);
        low = std::min(low, at);
        high = std::max(high, at);
      }
      interpolated.attributes[j] = std::clamp(static_cast<float>(value), low, high);
    }
    return interpolated;
  }
};

}  // namespace

std::optional<ClipVertex> exact_edge_intersection(const VertexTransform& transform, Outcode plane,
                                                  const ClipVertex& a, const ClipVertex& b,
                                                  int attribute_count) {
  ExactVertices<2> edge(transform, {&a, &b});
  ExactSum distances[2];
  for (std::size_t k = 0; k < 2; ++k) distances[k] = edge.exact[k].distance(transform, plane);
  edge.weights[0].add_product(distances[1], 1);
  edge.weights[1].add_product(distances[0], -1);
  return edge.interpolate(attribute_count);
}

std::optional<ClipVertex> exact_two_plane_intersection(const VertexTransform& transform, Outcode plane,
                                                       Outcode other, const ClipVertex& a,
                                                       const ClipVertex& b, const ClipVertex& c,
                                                       int attribute_count) {
  ExactVertices<3> triangle(transform, {&a, &b, &c});
  ExactSum on_plane[3], on_other[3];
  for (std::size_t k = 0; k < 3; ++k) {
    on_plane[k] = triangle.exact[k].distance(transform, plane);
    on_other[k] = triangle.exact[k].distance(transform, other);
  }
  // Weights for which the weighted distances from both planes sum to 0: the cross product of the distances.
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t next = (k + 1) % 3, last = (k + 2) % 3;
    triangle.weights[k].add_product(on_plane[next], on_other[last], 1);
    triangle.weights[k].add_product(on_plane[last], on_other[next], -1);
  }
  return triangle.interpolate(attribute_count);
}

}  // namespace tessera::detail
