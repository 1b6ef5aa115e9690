#include "framebuffer/extreme_colors.h"

#include <array>
#include <cstddef>
#include <span>

#include "framebuffer/nearest_center.h"

namespace tessera::detail {

namespace {

using Direction = std::array<int, 3>;  ///< components -1, 0 or 1; any length

std::vector<Direction> directions() {
  std::vector<Direction> all;
  for (int l = -1; l <= 1; ++l)
    for (int a = -1; a <= 1; ++a)
      for (int b = -1; b <= 1; ++b)
        if (l != 0 || a != 0 || b != 0) all.push_back({l, a, b});
  return all;
}

std::size_t extreme_point(const ColorPoints& points, const Direction& direction) {
  const auto along = [&](std::size_t i) {
    return static_cast<float>(direction[0]) * points.l[i] + static_cast<float>(direction[1]) * points.a[i] +
           static_cast<float>(direction[2]) * points.b[i];
  };
  std::size_t best = 0;
  for (std::size_t i = 1; i < points.count; ++i)
    if (along(i) > along(best)) best = i;
  return best;
}

}  // namespace

void keep_extremes(const ColorPoints& points, InstructionSet isa, std::vector<Oklab>& centers) {
  NearestCenters nearest;
  nearest_centers(points, ColorPoints(std::span<const Oklab>(centers)), isa, nearest);
  std::vector<double> weights(centers.size());
  double error = 0;
  for (std::size_t i = 0; i < points.count; ++i) {
    weights[nearest.center[i]] += points.weight[i];
    error += points.weight[i] * static_cast<double>(nearest.squared_distance[i]);
  }
  double budget = error / 8;
  std::vector<bool> moved(centers.size());
  for (const Direction& direction : directions()) {
    const std::size_t extreme = extreme_point(points, direction);
    const std::size_t k = nearest.center[extreme];
    // Moving the mean of points of weight W by a distance d adds W d^2 to the sum of their squared distances.
    const double cost = weights[k] * squared_point_distance(centers[k], points[extreme]);
    if (moved[k] || cost > budget) continue;
    budget -= cost;
    moved[k] = true;
    centers[k] = points[extreme];
  }
}

}  // namespace tessera::detail
