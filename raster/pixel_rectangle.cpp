#include "raster/pixel_rectangle.h"

#include <algorithm>
#include <cmath>

#include "raster/sample_positions.h"

namespace tessera::detail {
namespace {

// Window coordinates of a sample; exact.
double window_x(int x, SamplePosition sample) {
  return x + 0.5 + static_cast<double>(sample.x) / kSubpixelScale;
}
double window_y(int y, int frame_height, SamplePosition sample) {
  return frame_height - y - 0.5 - static_cast<double>(sample.y) / kSubpixelScale;
}

int clamped(double pixel, int max) {
  return static_cast<int>(std::clamp(pixel, 0.0, static_cast<double>(max)));
}

/// Rows or columns of texels, and the offsets of the samples from a pixel's centre.
struct Axis {
  double start, zoom;
  int count;
  int samples;
  double offset[kMaxSamples];

  /// True if a sample of the pixel at `center` hits a texel. Not inlined, for code size: four calls.
  [[gnu::noinline]] bool has_texel(double center) const {
    for (int s = 0; s < samples; ++s)
      if (texel_at(start, zoom, count, center + offset[s]) != kNoTexel) return true;
    return false;
  }
};

/// Shrinks [first, last) by the pixels at its ends that hit no texel.
template <class Center>
void tighten(int& first, int& last, const Axis& axis, const Center& center) {
  while (first < last && !axis.has_texel(center(first))) ++first;
  while (first < last && !axis.has_texel(center(last - 1))) --last;
}

}  // namespace

std::int32_t texel_at(double start, double zoom, int count, double position) {
  // A border has the same value for the texels on both sides, and borders are monotonic: if border n is
  // passed, so are those before it.
  const auto passed = [&](int n) {
    return zoom > 0 ? start + zoom * n <= position : position < start + zoom * n;
  };
  if (zoom == 0 || !passed(0) || passed(count)) return kNoTexel;
  // The quotient is correct unless it rounds across a border.
  const double guess = std::floor((position - start) / zoom);
  if (guess >= 0 && guess < count && passed(static_cast<int>(guess)) && !passed(static_cast<int>(guess) + 1))
    return static_cast<std::int32_t>(guess);
  int low = 0, high = count;
  while (high - low > 1) {
    const int middle = low + (high - low) / 2;
    if (passed(middle)) low = middle;
    else high = middle;
  }
  return low;
}

PixelRect covered_pixels(const PixelRectangle& texels, int frame_width, int frame_height, int samples) {
  const auto [left, right] = std::minmax({texels.x, texels.x + texels.zoom_x * texels.width});
  const auto [low, high] = std::minmax({texels.y, texels.y + texels.zoom_y * texels.height});
  PixelRect rect{
      clamped(std::floor(left), frame_width), frame_height - clamped(std::ceil(high), frame_height),
      clamped(std::ceil(right), frame_width), frame_height - clamped(std::floor(low), frame_height)};
  Axis x{texels.x, texels.zoom_x, texels.width, samples, {}};
  Axis y{texels.y, texels.zoom_y, texels.height, samples, {}};
  for (int s = 0; s < samples; ++s) {
    const SamplePosition position = sample_positions(samples)[s];
    x.offset[s] = window_x(0, position) - 0.5;
    y.offset[s] = window_y(0, 0, position) + 0.5;
  }
  tighten(rect.x0, rect.x1, x, [](int pixel) { return pixel + 0.5; });
  tighten(rect.y0, rect.y1, y, [&](int pixel) { return frame_height - pixel - 0.5; });
  return rect;
}

void texel_columns(const PixelRectangle& texels, int x0, int x1, int samples, int sample,
                   std::int32_t* columns) {
  const SamplePosition position = sample_positions(samples)[sample];
  for (int x = x0; x < x1; ++x)
    *columns++ = texel_at(texels.x, texels.zoom_x, texels.width, window_x(x, position));
}

void texel_rows(const PixelRectangle& texels, int y0, int y1, int frame_height, int samples, int sample,
                std::int32_t* rows) {
  const SamplePosition position = sample_positions(samples)[sample];
  for (int y = y0; y < y1; ++y) {
    const std::int32_t from_below =
        texel_at(texels.y, texels.zoom_y, texels.height, window_y(y, frame_height, position));
    *rows++ = from_below == kNoTexel ? kNoTexel : texels.height - 1 - from_below;
  }
}

}  // namespace tessera::detail
