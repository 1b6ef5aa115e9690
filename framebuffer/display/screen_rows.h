// Rows of light of a screen, in the columns of its image, with what is left of earlier frames.
#pragma once

#include <cstddef>
#include <vector>

#include "framebuffer/display/light_source.h"
#include "framebuffer/display/resample_rows.h"
#include "framebuffer/display/screen_layout.h"

namespace tessera::detail {

/// Light that a long phosphor keeps from frame to frame.
struct Afterglow {
  bool is_kept = false;
  double kept_per_frame = 0;  ///< share of the light that is left after a frame
};

class ScreenRows {
 public:
  ScreenRows() = default;
  ScreenRows(const ScreenLayout& layout, int row_count, Afterglow afterglow);

  int blocks() const { return (row_count_ + kBlockRows - 1) / kBlockRows; }

  /// Replaces the light of a block of rows by that of the source's picture.
  /// @param frames  since the picture before, which was shown by all of them; ignored if is_first
  void emit(LightSource& source, const ScreenLayout& layout, ResampleRowsFn* resample, int block,
            bool is_first, std::int64_t frames);

  /// Light that the picture excites.
  const float* present(int row, std::size_t plane) const { return present_.data() + offset(row, plane); }
  /// Light that was left after the excitation by the frame before; only with afterglow.
  const float* earlier(int row, std::size_t plane) const { return earlier_.data() + offset(row, plane); }
  /// Offset of the columns of the scatter grid from those of the image.
  std::size_t scatter_offset() const { return image_stride_; }

  bool has_afterglow() const { return afterglow_.is_kept; }

 private:
  std::size_t offset(int row, std::size_t plane) const {
    return (static_cast<std::size_t>(row) * planes_ + plane) * stride_;
  }
  void keep_light(std::size_t begin, std::size_t end, std::int64_t frames);
  void assume_steady_light(std::size_t begin, std::size_t end);

  int row_count_ = 0;
  std::size_t planes_ = 0, image_stride_ = 0, stride_ = 0;
  Afterglow afterglow_;
  std::vector<float> present_, earlier_;  ///< [row][plane][columns of the image, then of the scatter grid]
};

/// Rounds up to whole vectors: rows are processed with up to 16 lanes.
constexpr std::size_t padded_columns(int columns) {
  return (static_cast<std::size_t>(columns) + 15) / 16 * 16;
}

}  // namespace tessera::detail
