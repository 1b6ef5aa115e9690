#include "rasterize_point.h"

#include <algorithm>
#include <cmath>

namespace tessera::reference {
namespace {

// First of n pixels in a row around `at`: an odd number is centred on the pixel that contains it, an even
// number on the nearest border between pixels.
std::int64_t first_pixel(std::int64_t at, std::int64_t n) {
  const std::int64_t middle = n % 2 == 1 ? at : at + kSubpixels / 2;
  return (middle >> 8) - n / 2;
}
static_assert(kSubpixels == 1 << 8);

bool is_in_disc(Point p, double diameter) {
  // Exact, and so are the squares, near the disc.
  const auto x = static_cast<double>(p.x), y = static_cast<double>(p.y);
  const double radius = diameter * kSubpixels / 2;
  return x * x + y * y <= radius * radius;
}

}  // namespace

void rasterize_point(const WindowVertex& vertex, double size, double depth_offset, const Window& window,
                     const FragmentCallback& take) {
  Fragment fragment;
  fragment.depth.fill(std::clamp(vertex.depth + depth_offset, 0.0, 1.0));
  fragment.weights = vertex.weights;
  fragment.weights_dx = fragment.weights_dy = CornerWeights(vertex.weights.size(), 0.0);
  const double used = std::min(size, kMaxSize);
  const auto whole = std::max(std::int64_t{1}, static_cast<std::int64_t>(std::floor(used + 0.5)));
  const auto reach = static_cast<std::int64_t>(std::ceil(used)) * kSubpixels;
  const Point square{first_pixel(vertex.at.x, whole), first_pixel(vertex.at.y, whole)};
  const bool is_disc = window.samples > 1;
  const Pixels pixels =
      is_disc ? visible_pixels(vertex.at - Point{reach, reach}, vertex.at + Point{reach, reach}, window)
              : visible_pixels(pixel_center(square.x, square.y),
                               pixel_center(square.x + whole - 1, square.y + whole - 1), window);
  const std::span<const Point> offsets = sample_offsets(window.samples);
  for (std::int64_t y = pixels.first_y; y <= pixels.last_y; ++y)
    for (std::int64_t x = pixels.first_x; x <= pixels.last_x; ++x) {
      fragment.x = static_cast<int>(x + window.viewport.x);
      fragment.y = static_cast<int>(y + window.viewport.y);
      fragment.coverage = is_disc ? 0 : 1;
      for (std::size_t i = 0; is_disc && i < offsets.size(); ++i)
        if (is_in_disc(pixel_center(x, y) + offsets[i] - vertex.at, used)) fragment.coverage |= 1u << i;
      if (fragment.coverage != 0) take(fragment);
    }
}

}  // namespace tessera::reference
