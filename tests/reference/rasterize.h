// Which samples a triangle covers, and where in the triangle each pixel lies: snapped vertices, exact edge functions, the
// top-left rule, at each sample's own position. Nothing here knows of colours.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

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
};

/// The part that two rectangles have in common; width or height 0 if there is none.
Rect intersection(Rect a, Rect b);

/// A guard band that keeps every snapped coordinate exact in the edge functions (see rasterize.cpp).
ClipVolume clip_volume(const Camera& camera, Rect viewport);

inline constexpr std::size_t kMaxSamples = 8;

/// A sample's place in 1/16 pixel from the pixel's centre, y up.
struct SamplePosition {
  int x = 0, y = 0;
};

/// @param samples  1, 4 or 8
std::span<const SamplePosition> sample_positions(int samples);

/// One pixel of which at least one sample is covered.
struct Fragment {
  int x = 0, y = 0;  ///< window, y up
  std::uint32_t coverage = 0;               ///< bit i: sample i is covered
  std::array<double, kMaxSamples> depth{};  ///< of each covered sample: after depth range and offset, 0..1, not yet rounded to a level
  Vec3 share;        ///< perspective-correct share of each of the triangle's three corners, at the pixel's centre, covered or not
};

/// A polygon in the window: the clipped triangle, snapped.
class WindowPolygon {
 public:
  WindowPolygon(const std::vector<ClipVertex>& polygon, const Window& window);

  /// Twice the area of the snapped polygon in (1/256 pixel)^2, above 0 if it is counter-clockwise with y up.
  std::int64_t signed_area() const { return signed_area_; }

  /// The larger of |dz/dx| and |dz/dy| of window depth, for each pixel.
  double depth_slope() const;

  /// The largest |z| of its vertices in the window.
  double largest_depth() const;

  /// Calls `take` for each pixel covered.
  /// @param depth_offset  added to every depth before it is clamped to 0..1.
  void for_each_fragment(double depth_offset, const std::function<void(const Fragment&)>& take) const;

 private:
  struct Vertex {
    std::int64_t x, y;  // 1/256 pixel from the viewport's lower left corner
    double depth;
    double inverse_w;
    Vec3 share;
  };

  /// Counter-clockwise, of positive area.
  struct Part {
    Vertex a, b, c;
    std::int64_t area;
  };

  const Part& largest_part() const;

  std::vector<Vertex> vertices_;
  std::vector<Part> parts_;  // the polygon as a fan
  std::int64_t signed_area_ = 0;
  Window window_;
};

}  // namespace tessera::reference
