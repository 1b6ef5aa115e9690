// FLIP for pictures of low dynamic range: a map of the differences that a viewer sees when two pictures
// alternate. Andersson and others, FLIP: A Difference Evaluator for Alternating Images, High Performance
// Graphics 2020; constants as in NVIDIA's implementation, version 1.7.
#pragma once

#include <numbers>
#include <vector>

#include "engine/program/compare/pixel_view.h"

namespace tessera::program {

/// A monitor 0.7 m wide with 3840 pixels per row, seen from 0.7 m: 67.0206.
inline constexpr double kDefaultPixelsPerDegree = 0.7 * 3840 / 0.7 * std::numbers::pi / 180;
inline constexpr double kMinPixelsPerDegree = 1;
inline constexpr double kMaxPixelsPerDegree = 1000;

struct FlipOptions {
  /// Pixels per degree of the viewer's visual angle, kMinPixelsPerDegree .. kMaxPixelsPerDegree.
  double pixels_per_degree = kDefaultPixelsPerDegree;
  int threads = 0;  ///< 1 or more; 0: one per core
};

struct FlipErrors {
  /// Error of each pixel, 0 (no visible difference) to 1; rows from the top without gaps.
  std::vector<float> map;
  double mean = 0;
  /// Smallest error of the map that at least 99 % of the pixels do not exceed.
  double percentile_99 = 0;
  double largest = 0;
};

/// Compares two sRGB pictures. Swapping them changes nothing.
/// - Returns the same bits for any number of threads, on every machine: see exact_functions.h.
/// - Cost: time grows with pixels_per_degree; memory is 4 bytes per pixel, and scratch per thread.
/// @throws Error for pictures of different sizes, or pixels_per_degree out of range
FlipErrors flip_errors(const PixelView& picture, const PixelView& reference, const FlipOptions& options = {});

}  // namespace tessera::program
