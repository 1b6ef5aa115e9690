// The window that primitives are rasterized in: snapped vertices, pixels, samples, fragments.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>

#include "clip.h"
#include "scene.h"

namespace tessera::reference {

/// Where on the screen a draw may leave fragments.
struct Window {
  Rect viewport;  ///< may reach beyond the buffer
  Rect visible;   ///< viewport, scissor and buffer in common
  std::array<double, 2> depth_range{0, 1};
  bool reversed = false;
  int samples = 1;
  bool derivatives = false;  ///< fragments bring the derivatives of their shares
};

/// The part that two rectangles have in common; width or height 0 if there is none.
Rect intersection(Rect a, Rect b);

/// Vertices are snapped to 1/256 pixel.
inline constexpr std::int64_t kSubpixels = 256;

/// Bound of |coordinate| from the viewport's centre, in pixels. An edge function is a difference of two
/// products of coordinate differences, each at most twice the extent.
inline constexpr std::int64_t kExtent = std::int64_t{1} << 21;
inline constexpr std::int64_t kMaxDifference = 2 * (kExtent + 1) * kSubpixels;
static_assert(kMaxDifference <= INT64_MAX / kMaxDifference / 2);

/// Points and lines that are larger, in pixels, are drawn at this size, which more than covers any window.
inline constexpr double kMaxSize = 1 << 18;

/// A guard band that keeps every snapped coordinate within kExtent.
ClipVolume clip_volume(const Camera& camera, Rect viewport);

/// In 1/256 pixel from the viewport's lower left corner.
struct Point {
  std::int64_t x = 0, y = 0;
};

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

/// Where the samples of a pixel lie, from its centre. Vertices lie on a grid of which these are points.
/// @param samples  1, 4 or 8
std::span<const Point> sample_offsets(int samples);

/// One pixel of which at least one sample is covered.
struct Fragment {
  int x = 0, y = 0;            ///< window, y up
  std::uint32_t coverage = 0;  ///< bit i: sample i is covered
  std::array<double, kMaxSamples>
      depth{};  ///< of each covered sample: after depth range and offset, 0..1, not yet rounded to a level
  CornerWeights weights;  ///< perspective-correct, of each of the primitive's corners, at the pixel's centre,
                          ///< covered or not
  /// Derivatives of the shares there, for each pixel, if the window asks for them. Of a line the one along it
  /// stands in x [GL 2.1, equation 3.15]; of a point they are 0.
  CornerWeights weights_dx, weights_dy;
};

using FragmentCallback = std::function<void(const Fragment&)>;

/// The visible pixels from column and row `first` to `last`, numbered from the viewport's lower left corner.
struct Pixels {
  std::int64_t first_x = 0, last_x = 0, first_y = 0, last_y = 0;
};

/// The visible pixels of the smallest rectangle that holds all points between `low` and `high`.
Pixels visible_pixels(Point low, Point high, const Window& window);

inline Point pixel_centre(std::int64_t x, std::int64_t y) {
  return {x * kSubpixels + kSubpixels / 2, y * kSubpixels + kSubpixels / 2};
}

}  // namespace tessera::reference
