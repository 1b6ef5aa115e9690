#include "framebuffer/display/screen_rows.h"

#include <algorithm>

#include "framebuffer/exact_functions.h"

namespace tessera::detail {

ScreenRows::ScreenRows(const ScreenLayout& layout, int row_count, Afterglow afterglow)
    : row_count_(row_count),
      planes_(layout.planes.size()),
      image_stride_(padded_columns(layout.columns.count)),
      stride_(image_stride_ + padded_columns(layout.scatter.columns.count)),
      afterglow_(afterglow),
      present_(static_cast<std::size_t>(row_count) * planes_ * stride_),
      earlier_(afterglow.is_kept ? present_.size() : 0) {}

void ScreenRows::emit(LightSource& source, const ScreenLayout& layout, ResampleRowsFn* resample, int block,
                      bool is_first, std::int64_t frames) {
  const int first = block * kBlockRows;
  const int rows = std::min(kBlockRows, row_count_ - first);
  const std::size_t begin = offset(first, 0), end = offset(first + rows, 0);
  if (afterglow_.is_kept && !is_first) keep_light(begin, end, frames);

  const std::size_t plane_values = static_cast<std::size_t>(source.samples()) * kBlockRows;
  std::vector<float> light(plane_values * planes_);
  source.emit(block, light.data());
  const auto row_stride = static_cast<std::ptrdiff_t>(planes_ * stride_);
  for (std::size_t plane = 0; plane < planes_; ++plane) {
    float* target = present_.data() + offset(first, plane);
    const float* samples = light.data() + plane * plane_values;
    resample(samples, layout.planes[plane].horizontal, rows, target, row_stride);
    if (layout.scatter.share > 0)
      resample(samples, layout.scatter.horizontal, rows, target + image_stride_, row_stride);
  }
  if (afterglow_.is_kept && is_first) assume_steady_light(begin, end);
}

/// After m frames with excitation E, of a phosphor that keeps the share q of its light and had the light G
/// after the frame before: q^m G + (1 + q + .. + q^(m-1)) E.
void ScreenRows::keep_light(std::size_t begin, std::size_t end, std::int64_t frames) {
  const double q = afterglow_.kept_per_frame;
  const double kept = exponential(static_cast<double>(frames) * natural_log(q));
  const auto share = static_cast<float>(kept), gain = static_cast<float>((1 - kept) / (1 - q));
  for (std::size_t i = begin; i < end; ++i) earlier_[i] = share * earlier_[i] + gain * present_[i];
}

/// A picture that was shown for a long time: 1 + q + q^2 + ... = 1 / (1 - q).
void ScreenRows::assume_steady_light(std::size_t begin, std::size_t end) {
  const auto gain = static_cast<float>(1 / (1 - afterglow_.kept_per_frame));
  for (std::size_t i = begin; i < end; ++i) earlier_[i] = gain * present_[i];
}

}  // namespace tessera::detail
