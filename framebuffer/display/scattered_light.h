// Light that the glass of a tube scatters.
#pragma once

#include <cstddef>
#include <vector>

#include "framebuffer/display/image_rows.h"
#include "framebuffer/display/line_exposure.h"
#include "framebuffer/display/screen_layout.h"
#include "framebuffer/display/screen_rows.h"

namespace tessera::detail {

/// Scattered light on the rows of the scatter grid, in the columns of the image.
class ScatteredLight {
 public:
  ScatteredLight() = default;
  explicit ScatteredLight(const ScreenLayout& layout);

  int rows() const { return static_cast<int>(row_count_); }

  /// Computes a row of the grid. Calls for different rows may run at the same time.
  void compute(int row, const ScreenLayout& layout, const ScreenRows& light, const LineExposure& exposure);

  /// Adds the two rows of the grid between which a row of the image lies.
  void add_to(ImageRow& target, const ScreenLayout& layout, int image_row) const;

 private:
  float* row(std::size_t color, std::size_t y) { return values_.data() + (color * row_count_ + y) * stride_; }
  const float* row(std::size_t color, std::size_t y) const {
    return values_.data() + (color * row_count_ + y) * stride_;
  }

  std::size_t row_count_ = 0, stride_ = 0;
  std::vector<float> values_;  ///< [color][grid row][image column]
};

}  // namespace tessera::detail
