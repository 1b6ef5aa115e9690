#include "framebuffer/k_means.h"

#include <cstdint>
#include <span>

#include "framebuffer/check.h"
#include "framebuffer/nearest_center.h"

namespace tessera::detail {

namespace {

double error_of(const ColorPoints& points, const NearestCenters& nearest, std::size_t i) noexcept {
  return points.weight[i] * static_cast<double>(nearest.squared_distance[i]);
}

/// Moves centres without points to the points with the largest errors, a different one for each.
void move_unused(const ColorPoints& points, const std::vector<double>& weights, NearestCenters& nearest,
                 std::vector<Oklab>& centers) {
  for (std::size_t k = 0; k < centers.size(); ++k) {
    if (weights[k] > 0) continue;
    std::size_t worst = 0;
    for (std::size_t i = 1; i < points.count; ++i)
      if (error_of(points, nearest, i) > error_of(points, nearest, worst)) worst = i;
    if (!(error_of(points, nearest, worst) > 0)) return;
    centers[k] = points[worst];
    nearest.squared_distance[worst] = 0;
  }
}

/// Moves each centre to the mean of its points.
void move_to_means(const ColorPoints& points, UnusedCenters unused, NearestCenters& nearest,
                   std::vector<Oklab>& centers) {
  std::vector<Oklab> sums(centers.size());
  std::vector<double> weights(centers.size());
  for (std::size_t i = 0; i < points.count; ++i) {
    const std::size_t k = nearest.center[i];
    const double w = points.weight[i];
    const Oklab p = points[i];
    sums[k] = {sums[k].l + w * p.l, sums[k].a + w * p.a, sums[k].b + w * p.b};
    weights[k] += w;
  }
  for (std::size_t k = 0; k < centers.size(); ++k)
    if (weights[k] > 0) centers[k] = {sums[k].l / weights[k], sums[k].a / weights[k], sums[k].b / weights[k]};
  if (unused == UnusedCenters::move) move_unused(points, weights, nearest, centers);
}

}  // namespace

std::vector<Oklab> k_means(const ColorPoints& points, std::vector<Oklab> centers, int max_rounds,
                           InstructionSet isa, UnusedCenters unused) {
  TESSERA_ASSERT(!centers.empty());
  NearestCenters nearest;
  for (int round = 0; round < max_rounds; ++round) {
    const std::vector<Oklab> before = centers;
    nearest_centers(points, ColorPoints(std::span<const Oklab>(centers)), isa, nearest);
    move_to_means(points, unused, nearest, centers);
    if (centers == before) break;
  }
  return centers;
}

double clustering_error(const ColorPoints& points, const std::vector<Oklab>& centers, InstructionSet isa) {
  NearestCenters nearest;
  nearest_centers(points, ColorPoints(std::span<const Oklab>(centers)), isa, nearest);
  double error = 0;
  for (std::size_t i = 0; i < points.count; ++i) error += error_of(points, nearest, i);
  return error;
}

}  // namespace tessera::detail
