// Clustering: kernels against their scalar twin, k-means against exhaustive search.
#include "framebuffer/k_means.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <span>
#include <vector>

#include "framebuffer/instruction_set.h"
#include "framebuffer/median_cut.h"
#include "framebuffer/nearest_center.h"
#include "framebuffer/nearest_center_reference.h"

namespace tessera::detail::k_means_test {
namespace {

std::vector<WeightedColor> random_colors(std::size_t count, std::mt19937& random) {
  std::vector<WeightedColor> colors(count);
  for (WeightedColor& c : colors) {
    c.color = {static_cast<std::uint8_t>(random() % 256), static_cast<std::uint8_t>(random() % 256),
               static_cast<std::uint8_t>(random() % 256)};
    c.pixels = 1 + random() % 100;
  }
  return colors;
}

std::vector<Oklab> some_points(const ColorPoints& points, std::size_t count, std::mt19937& random) {
  std::vector<Oklab> centers;
  for (std::size_t k = 0; k < count; ++k) centers.push_back(points[random() % points.count]);
  return centers;
}

// Centres are points, some twice, so that distances of 0 and ties occur.
TEST(NearestCenters, EqualTheScalarTwinOnEveryInstructionSet) {
  std::mt19937 random(1);
  for (const std::size_t count : {1u, 15u, 16u, 17u, 1000u})
    for (const std::size_t centers : {1u, 2u, 7u, 256u}) {
      const ColorPoints points(random_colors(count, random));
      const std::vector<Oklab> some = some_points(points, centers, random);
      const ColorPoints center_points{std::span<const Oklab>(some)};
      const NearestCenters expected = nearest_centers_reference(points, center_points);
      for (const InstructionSet isa : available_isas()) {
        NearestCenters found;
        nearest_centers(points, center_points, isa, found);
        EXPECT_EQ(found.center, expected.center) << static_cast<int>(isa);
        EXPECT_EQ(found.squared_distance, expected.squared_distance) << static_cast<int>(isa);
      }
    }
}

TEST(KMeans, ErrorNeverGrowsFromRoundToRound) {
  std::mt19937 random(2);
  const InstructionSet isa = available_isas().front();
  for (int repeat = 0; repeat < 20; ++repeat) {
    const ColorPoints points(random_colors(500, random));
    std::vector<Oklab> centers = some_points(points, 20, random);
    double error = clustering_error(points, centers, isa);
    for (int round = 0; round < 10; ++round) {
      centers = k_means(points, centers, 1, isa);
      const double next = clustering_error(points, centers, isa);
      EXPECT_LE(next, error * (1 + 1e-5)) << repeat << " " << round;
      error = next;
    }
  }
}

TEST(KMeans, UnusedCentersMoveToTheLargestErrors) {
  const std::vector<WeightedColor> colors = {{{0, 0, 0}, 10}, {{255, 255, 255}, 10}, {{255, 0, 0}, 1}};
  const ColorPoints points(colors);
  const std::vector<Oklab> start(3, points[0]);
  const InstructionSet isa = available_isas().front();
  EXPECT_EQ(clustering_error(points, k_means(points, start, 3, isa), isa), 0);
}

/// Smallest error of all partitions of the points into `clusters` groups.
double least_error(const ColorPoints& points, std::size_t clusters, InstructionSet isa) {
  std::size_t partitions = 1;
  for (std::size_t i = 0; i < points.count; ++i) partitions *= clusters;
  double least = 1e300;
  for (std::size_t code = 0; code < partitions; ++code) {
    std::vector<Oklab> sums(clusters);
    std::vector<double> weights(clusters);
    std::size_t digits = code;
    for (std::size_t i = 0; i < points.count; ++i, digits /= clusters) {
      const std::size_t k = digits % clusters;
      const Oklab p = points[i];
      const double w = points.weight[i];
      sums[k] = {sums[k].l + w * p.l, sums[k].a + w * p.a, sums[k].b + w * p.b};
      weights[k] += w;
    }
    if (*std::min_element(weights.begin(), weights.end()) == 0) continue;
    for (std::size_t k = 0; k < clusters; ++k)
      sums[k] = {sums[k].l / weights[k], sums[k].a / weights[k], sums[k].b / weights[k]};
    least = std::min(least, clustering_error(points, sums, isa));
  }
  return least;
}

// k-means finds local optima: the error may be larger than the least, on average by a few percent.
TEST(KMeans, IsNearTheBestOfAllPartitionsOfFewColors) {
  std::mt19937 random(3);
  const InstructionSet isa = available_isas().front();
  double ratios = 0;
  constexpr int kCases = 60;
  for (int i = 0; i < kCases; ++i) {
    const std::size_t clusters = 2 + static_cast<std::size_t>(i) % 2;
    const ColorPoints points(random_colors(8, random));
    const double cut_error = clustering_error(points, median_cut(points, clusters), isa);
    const double error =
        clustering_error(points, k_means(points, median_cut(points, clusters), 20, isa), isa);
    const double least = least_error(points, clusters, isa);
    EXPECT_LE(error, cut_error * (1 + 1e-6));
    EXPECT_GE(error, least * (1 - 1e-5));
    EXPECT_LE(error, least * 1.8);
    ratios += error / least;
  }
  EXPECT_LE(ratios / kCases, 1.08);
}

TEST(MedianCut, SplitsAllPointsIfThereAreEnoughBoxes) {
  std::mt19937 random(4);
  const ColorPoints points(random_colors(40, random));
  EXPECT_EQ(median_cut(points, 100).size(), 40u);
  EXPECT_LE(clustering_error(points, median_cut(points, 100), available_isas().front()), 1e-9);
}

}  // namespace
}  // namespace tessera::detail::k_means_test
