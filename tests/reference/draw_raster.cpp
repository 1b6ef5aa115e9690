#include "draw_raster.h"

#include <algorithm>
#include <cmath>

#include "fragment_pipeline.h"
#include "lighting.h"
#include "texture_sampler.h"

namespace tessera::reference {
namespace {

constexpr bool kIsBack = false;

/// A rectangle in the window; the left and lower borders are inclusive, the right and upper ones exclusive.
struct Region {
  double left, right, bottom, top;

  bool contains(double x, double y) const { return left <= x && x < right && bottom <= y && y < top; }
};

Region between(double x0, double x1, double y0, double y1) {
  return {std::min(x0, x1), std::max(x0, x1), std::min(y0, y1), std::max(y0, y1)};
}

/// Passes a fragment to the pipeline for each visible pixel with a sample in the region.
void fill(const Region& region, double depth, const FragmentState& state, SampleBuffers& buffers,
          FragmentPipeline& pipeline) {
  const Rect visible = intersection(buffers.rect(), state.scissor.value_or(buffers.rect()));
  const auto pixel = [](double coordinate, int least, int count) {
    return static_cast<int>(
        std::clamp(std::floor(coordinate), static_cast<double>(least), static_cast<double>(least + count)));
  };
  const std::span<const Point> offsets = sample_offsets(buffers.format().samples);
  const auto position = [](int pixel_number, std::int64_t offset) {
    return pixel_number + 0.5 + static_cast<double>(offset) / static_cast<double>(kSubpixels);
  };
  Fragment fragment;
  fragment.depth.fill(depth);
  const int end_x = pixel(region.right + 1, visible.x, visible.width);
  const int end_y = pixel(region.top + 1, visible.y, visible.height);
  for (int y = pixel(region.bottom, visible.y, visible.height); y < end_y; ++y)
    for (int x = pixel(region.left, visible.x, visible.width); x < end_x; ++x) {
      fragment.x = x;
      fragment.y = y;
      fragment.coverage = 0;
      for (std::size_t i = 0; i < offsets.size(); ++i)
        if (region.contains(position(x, offsets[i].x), position(y, offsets[i].y)))
          fragment.coverage |= 1u << i;
      if (fragment.coverage != 0) pipeline.take(fragment);
    }
}

}  // namespace

void draw_bitmap(const Bitmap& bitmap, std::int32_t command, SampleBuffers& buffers) {
  const Vec4 color = clamp01(bitmap.color);
  FragmentPipeline pipeline(
      bitmap,
      [&](const Fragment&) {
        return Shade{color, {}};
      },
      {command, 0, kIsBack}, buffers);
  const double left = std::floor(bitmap.at[0]);
  const double bottom = std::floor(bitmap.at[1]);
  std::size_t bit = 0;
  for (int y = 0; y < bitmap.height; ++y)
    for (int x = 0; x < bitmap.width; ++x)
      if (bitmap.bits[bit++])
        fill({left + x, left + x + 1, bottom + y, bottom + y + 1}, bitmap.raster_depth, bitmap, buffers,
             pipeline);
}

void draw_image(const ImageDrawing& drawing, std::int32_t command, SampleBuffers& buffers) {
  const Image& image = drawing.image;
  Vec4 color;
  FragmentPipeline pipeline(
      drawing,
      [&](const Fragment&) {
        return Shade{color, {}};
      },
      {command, 0, kIsBack}, buffers);
  const auto x_of = [&](int n) { return drawing.at[0] + drawing.zoom[0] * n; };
  const auto y_of = [&](int m) { return drawing.at[1] + drawing.zoom[1] * m; };
  for (int m = 0; m < image.height; ++m)
    for (int n = 0; n < image.width; ++n) {
      color = pixel_color(image, n, m);
      fill(between(x_of(n), x_of(n + 1), y_of(m), y_of(m + 1)), drawing.raster_depth, drawing, buffers,
           pipeline);
    }
}

}  // namespace tessera::reference
