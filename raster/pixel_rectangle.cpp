#include "raster/pixel_rectangle.h"

#include <algorithm>
#include <cmath>

#include "raster/sample_positions.h"

namespace tessera {
namespace {

// Where a sample lies in the window; exact.
double window_x(int x, SamplePosition sample) { return x + 0.5 + static_cast<double>(sample.x) / kSubpixelScale; }
double window_y(int y, int frame_height, SamplePosition sample) { return frame_height - y - 0.5 - static_cast<double>(sample.y) / kSubpixelScale; }

int clamped(double pixel, int most) { return static_cast<int>(std::clamp(pixel, 0.0, static_cast<double>(most))); }

/// Pixels [first, last) of a row or column between two places, without those at its ends that see(pixel) nothing.
template <class Sees>
void tighten(int& first, int& last, const Sees& sees) {
  while (first < last && !sees(first)) ++first;
  while (first < last && !sees(last - 1)) --last;
}

}  // namespace

std::int32_t texel_at(double start, double zoom, int count, double place) {
  // The borders are the same numbers for the texels on both sides, and never turn back: those up to some n are passed.
  const auto passed = [&](int n) { return zoom > 0 ? start + zoom * n <= place : place < start + zoom * n; };
  if (zoom == 0 || !passed(0) || passed(count)) return kNoTexel;
  // The quotient is right but where it rounds next to a border.
  const double guess = std::floor((place - start) / zoom);
  if (guess >= 0 && guess < count && passed(static_cast<int>(guess)) && !passed(static_cast<int>(guess) + 1)) return static_cast<std::int32_t>(guess);
  int low = 0, high = count;
  while (high - low > 1) {
    const int middle = low + (high - low) / 2;
    (passed(middle) ? low : high) = middle;
  }
  return low;
}

PixelRect covered_pixels(const PixelRectangle& texels, int frame_width, int frame_height, int samples) {
  const auto [left, right] = std::minmax({texels.x, texels.x + texels.zoom_x * texels.width});
  const auto [low, high] = std::minmax({texels.y, texels.y + texels.zoom_y * texels.height});
  const SamplePosition* const positions = sample_positions(samples);
  const auto any_sample = [&](const auto& sees) { return std::any_of(positions, positions + samples, sees); };
  PixelRect rect{clamped(std::floor(left), frame_width), frame_height - clamped(std::ceil(high), frame_height), clamped(std::ceil(right), frame_width),
                 frame_height - clamped(std::floor(low), frame_height)};
  tighten(rect.x0, rect.x1, [&](int x) {
    return any_sample([&](SamplePosition s) { return texel_at(texels.x, texels.zoom_x, texels.width, window_x(x, s)) != kNoTexel; });
  });
  tighten(rect.y0, rect.y1, [&](int y) {
    return any_sample([&](SamplePosition s) { return texel_at(texels.y, texels.zoom_y, texels.height, window_y(y, frame_height, s)) != kNoTexel; });
  });
  return rect;
}

void texel_columns(const PixelRectangle& texels, int x0, int x1, int samples, int sample, std::int32_t* columns) {
  const SamplePosition position = sample_positions(samples)[sample];
  for (int x = x0; x < x1; ++x) *columns++ = texel_at(texels.x, texels.zoom_x, texels.width, window_x(x, position));
}

void texel_rows(const PixelRectangle& texels, int y0, int y1, int frame_height, int samples, int sample, std::int32_t* rows) {
  const SamplePosition position = sample_positions(samples)[sample];
  for (int y = y0; y < y1; ++y) {
    const std::int32_t from_below = texel_at(texels.y, texels.zoom_y, texels.height, window_y(y, frame_height, position));
    *rows++ = from_below == kNoTexel ? kNoTexel : texels.height - 1 - from_below;
  }
}

}  // namespace tessera
