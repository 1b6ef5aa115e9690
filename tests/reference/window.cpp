#include "window.h"

#include <algorithm>
#include <cmath>

namespace tessera::reference {
namespace {

// Relative to the viewport's centre, so that moving the viewport by whole pixels changes nothing.
std::int64_t snap(double pixels_from_center) {
  return static_cast<std::int64_t>(std::floor(pixels_from_center * kSubpixels + 0.5));
}

std::int64_t floor_pixel(std::int64_t subpixels) { return subpixels >> 8; }
static_assert(kSubpixels == 1 << 8);

// The standard patterns of Direct3D 11 in 1/16 pixel, flipped vertically: Direct3D's y points down. All
// samples are inside their pixel.
constexpr std::int64_t k16th = kSubpixels / 16;

template <std::size_t N>
constexpr std::array<Point, N> pattern(std::array<Point, N> sixteenths) {
  for (Point& p : sixteenths) p = {p.x * k16th, p.y * k16th};
  return sixteenths;
}

constexpr std::array<Point, 1> kCenter{};
constexpr auto kFour = pattern<4>({{{-2, 6}, {6, 2}, {-6, -2}, {2, -6}}});
constexpr auto kEight =
    pattern<8>({{{1, 3}, {-1, -3}, {5, -1}, {-3, 5}, {-5, -5}, {-7, 1}, {3, -7}, {7, 7}}});
static_assert(kEight.size() == kMaxSamples);

}  // namespace

Rect intersection(Rect a, Rect b) {
  const int left = std::max(a.x, b.x);
  const int right = std::min(a.x + a.width, b.x + b.width);
  const int bottom = std::max(a.y, b.y);
  const int top = std::min(a.y + a.height, b.y + b.height);
  return {left, bottom, std::max(0, right - left), std::max(0, top - bottom)};
}

ClipVolume clip_volume(const Camera& camera, Rect viewport) {
  const auto guard = [](int size) { return 2.0 * static_cast<double>(kExtent) / std::max(size, 1); };
  return {camera.reversed, camera.infinite_far, guard(viewport.width), guard(viewport.height)};
}

WindowVertex window_vertex(const ClipVertex& vertex, const Window& window) {
  const Rect& viewport = window.viewport;
  const Vec4 p = vertex.position;
  const double z = p.z / p.w;
  const double depth = window.reversed ? z : (z + 1) / 2;
  // Moving all samples is moving all snapped vertices the other way.
  return {
      {snap(p.x / p.w * viewport.width / 2) + viewport.width * kSubpixels / 2 - window.sample_shift.x,
       snap(p.y / p.w * viewport.height / 2) + viewport.height * kSubpixels / 2 - window.sample_shift.y},
      window.depth_range[0] + (window.depth_range[1] - window.depth_range[0]) * std::clamp(depth, 0.0, 1.0),
      1 / p.w,
      vertex.weights};
}

std::span<const Point> sample_offsets(int samples) {
  if (samples == 4) return kFour;
  if (samples == 8) return kEight;
  return kCenter;
}

Pixels visible_pixels(Point low, Point high, const Window& window) {
  const Rect& visible = window.visible;
  const std::int64_t left = visible.x - window.viewport.x;
  const std::int64_t bottom = visible.y - window.viewport.y;
  return {std::max(left, floor_pixel(low.x)), std::min(left + visible.width - 1, floor_pixel(high.x)),
          std::max(bottom, floor_pixel(low.y)), std::min(bottom + visible.height - 1, floor_pixel(high.y))};
}

}  // namespace tessera::reference
