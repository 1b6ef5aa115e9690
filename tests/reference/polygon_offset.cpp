#include "polygon_offset.h"

#include <algorithm>
#include <cmath>

namespace tessera::reference {

double smallest_difference(DepthFormat format, double largest_depth) {
  // Exponents of float; zero and denormals count as the smallest.
  constexpr int kMinExponent = -126;
  constexpr int kFractionBits = 23;
  switch (format) {
    case DepthFormat::kNone: return 0;
    case DepthFormat::kUnorm16: return 1 / (std::ldexp(1.0, 16) - 1);
    case DepthFormat::kUnorm24: return 1 / (std::ldexp(1.0, 24) - 1);
    case DepthFormat::kUnorm32: return 1 / (std::ldexp(1.0, 32) - 1);
    case DepthFormat::kFloat32: break;
  }
  const int exponent = largest_depth > 0 ? std::max(std::ilogb(largest_depth), kMinExponent) : kMinExponent;
  return std::ldexp(1.0, exponent - kFractionBits);
}

double depth_offset(const PolygonOffset& offset, std::span<const WindowPolygon> triangles,
                    DepthFormat format) {
  if (triangles.empty()) return 0;
  double largest_depth = 0;
  for (const WindowPolygon& triangle : triangles)
    largest_depth = std::max(largest_depth, triangle.largest_depth());
  const auto area = [](const WindowPolygon& triangle) { return std::abs(triangle.signed_area()); };
  const WindowPolygon& largest = *std::ranges::max_element(triangles, {}, area);
  const double slope = offset.factor != 0 ? offset.factor * largest.depth_slope() : 0;
  return slope + offset.units * smallest_difference(format, largest_depth);
}

}  // namespace tessera::reference
