// Light that the glass of a tube scatters.
#pragma once

#include <cstddef>
#include <vector>

#include "framebuffer/display/image_rows.h"
#include "framebuffer/display/line_exposure.h"
#include "framebuffer/display/screen_layout.h"
#include "framebuffer/display/screen_rows.h"

namespace tessera::detail {

/// Scattered light in the columns of the image, on the rows of the scatter grid.
class ScatteredLight {
 public:
  ScatteredLight() = default;
  explicit ScatteredLight(const ScreenLayout& layout);

  int grid_rows() const { return static_cast<int>(grid_rows_); }

  // Steps of a picture. Calls for different rows may run at the same time; each step needs all rows of the
  // one before.

  /// Mean light of the cells of a row, blurred along the row.
  void collect(int grid_row, const ScreenLayout& layout, const ScreenRows& light,
               const LineExposure& exposure);
  /// Blurs across rows, and interpolates in the columns of the image.
  void spread(int grid_row, const ScreenLayout& layout);
  /// Adds the two rows of the grid between which a row of the image lies.
  void add_to(ImageRow& target, const ScreenLayout& layout, int image_row) const;

 private:
  std::size_t cells_at(std::size_t color, std::size_t grid_row) const {
    return (color * grid_rows_ + grid_row) * grid_columns_;
  }
  std::size_t row_at(std::size_t color, std::size_t grid_row) const {
    return (color * grid_rows_ + grid_row) * stride_;
  }

  std::size_t grid_rows_ = 0, grid_columns_ = 0, stride_ = 0;
  std::vector<float> cells_;  ///< [color][grid row][grid column]
  std::vector<float> rows_;   ///< [color][grid row][image column]
};

}  // namespace tessera::detail
