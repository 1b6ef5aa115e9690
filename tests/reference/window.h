// Window space for rasterization: snapped vertices, pixels, samples, fragments.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>

#include "clip.h"
#include "scene.h"

namespace tessera::reference {

/// A point or a vector in 1/256 pixel; points start at the viewport's lower left corner.
struct Point {
  std::int64_t x = 0, y = 0;
};

/// Where a draw may produce fragments.
struct Window {
  Rect viewport;  ///< may reach beyond the buffer
  Rect visible;   ///< intersection of viewport, scissor and buffer
  std::array<double, 2> depth_range{0, 1};
  bool reversed = false;
  int samples = 1;
  bool derivatives = false;  ///< fragments need the derivatives of their weights
  Point sample_shift{};      ///< shift of all sample positions
};

/// Intersection of two rectangles; width or height 0 if empty.
Rect intersection(Rect a, Rect b);

/// Vertices are snapped to 1/256 pixel.
inline constexpr std::int64_t kSubpixels = 256;

/// Bound of |coordinate| from the viewport's centre, in pixels. An edge function is a difference of two
/// products of coordinate differences, each at most twice the extent.
inline constexpr std::int64_t kExtent = std::int64_t{1} << 21;
inline constexpr std::int64_t kMaxDifference = 2 * (kExtent + 1) * kSubpixels;
static_assert(kMaxDifference <= INT64_MAX / kMaxDifference / 2);

/// Larger points and lines are drawn at this size in pixels, which more than covers any window.
inline constexpr double kMaxSize = 1 << 18;

/// A guard band that keeps every snapped coordinate within kExtent.
ClipVolume clip_volume(const Camera& camera, Rect viewport);

inline Point operator+(Point a, Point b) { return {a.x + b.x, a.y + b.y}; }
inline Point operator-(Point a, Point b) { return {a.x - b.x, a.y - b.y}; }

struct WindowVertex {
  Point at;
  double depth = 0;  ///< after the depth range
  double inverse_w = 1;
  CornerWeights weights;
};

WindowVertex window_vertex(const ClipVertex& vertex, const Window& window);

inline constexpr std::size_t kMaxSamples = 8;

/// Sample positions relative to the pixel's centre, on the snapping grid.
/// @param samples  1, 4 or 8
std::span<const Point> sample_offsets(int samples);

/// A pixel with at least one covered sample.
struct Fragment {
  int x = 0, y = 0;            ///< window, y up
  std::uint32_t coverage = 0;  ///< bit i: sample i is covered
  /// Depth of each covered sample after depth range and offset, 0..1, not rounded to a level.
  std::array<double, kMaxSamples> depth{};
  /// Perspective-correct weights of the primitive's corners at the pixel's centre, covered or not.
  CornerWeights weights;
  /// Derivatives of the weights per pixel, if the window requests them. For a line, x holds the derivative
  /// along it [GL 2.1, equation 3.15]; for a point they are 0.
  CornerWeights weights_dx;
  CornerWeights weights_dy;
};

using FragmentCallback = std::function<void(const Fragment&)>;

/// Visible pixels from column and row `first` to `last`, counted from the viewport's lower left corner.
struct Pixels {
  std::int64_t first_x = 0;
  std::int64_t last_x = 0;
  std::int64_t first_y = 0;
  std::int64_t last_y = 0;
};

/// Visible pixels of the smallest rectangle that contains all points between `low` and `high`.
Pixels visible_pixels(Point low, Point high, const Window& window);

inline Point pixel_center(std::int64_t x, std::int64_t y) {
  return {x * kSubpixels + kSubpixels / 2, y * kSubpixels + kSubpixels / 2};
}

}  // namespace tessera::reference
