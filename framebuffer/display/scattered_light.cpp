#include "framebuffer/display/scattered_light.h"

#include <algorithm>

namespace tessera::detail {
namespace {

/// Place of a position between the points of a grid.
struct GridPlace {
  std::size_t point;  ///< the point before it
  double fraction;    ///< share of the way to the next point
};
GridPlace place_in(const PixelGrid& grid, double position_mm) {
  const double place = (position_mm - grid.center_mm(0)) / grid.pitch_mm;
  const double point = std::clamp(static_cast<double>(static_cast<int>(place)), 0.0, grid.count - 2.0);
  return {static_cast<std::size_t>(point), place - point};
}

void add(const float* values, float weight, std::vector<float>& sum) {
  for (std::size_t x = 0; x < sum.size(); ++x) sum[x] += weight * values[x];
}

}  // namespace

ScatteredLight::ScatteredLight(const ScreenLayout& layout) {
  if (layout.scatter.share == 0) return;
  grid_rows_ = static_cast<std::size_t>(layout.scatter.rows.count);
  grid_columns_ = static_cast<std::size_t>(layout.scatter.columns.count);
  stride_ = padded_columns(layout.columns.count);
  cells_.resize(layout.colors * grid_rows_ * grid_columns_);
  rows_.resize(layout.colors * grid_rows_ * stride_);
}

void ScatteredLight::collect(int grid_row, const ScreenLayout& layout, const ScreenRows& light,
                             const LineExposure& exposure) {
  const ResampleTable& table = layout.scatter.vertical;
  const int first = table.first[static_cast<std::size_t>(grid_row)];
  const float* weights = table.weights_of(grid_row);
  const std::vector<float>& blur = layout.scatter.blur;
  for (std::size_t color = 0; color < layout.colors; ++color) {
    std::vector<float> sum(grid_columns_, 0.0f);
    for (std::size_t plane = 0; plane < layout.planes.size(); ++plane) {
      if (layout.planes[plane].color != color) continue;
      for (int tap = 0; tap < table.taps; ++tap) {
        if (weights[tap] == 0) continue;
        const auto line = static_cast<std::size_t>(first + tap);
        const int row = (first + tap) / layout.lines_per_row;
        const float present = exposure.is_whole ? 1 : exposure.present[color][line];
        add(light.present(row, plane) + light.scatter_offset(), weights[tap] * present, sum);
        if (light.has_afterglow())
          add(light.earlier(row, plane) + light.scatter_offset(),
              weights[tap] * exposure.earlier[color][line], sum);
      }
    }
    // The outer cells only feed the blur.
    float* out = cells_.data() + cells_at(color, static_cast<std::size_t>(grid_row));
    const std::size_t reach = blur.size() / 2;
    for (std::size_t x = reach; x + reach < grid_columns_; ++x) {
      float blurred = 0;
      for (std::size_t k = 0; k < blur.size(); ++k) blurred += blur[k] * sum[x - reach + k];
      out[x] = blurred;
    }
  }
}

void ScatteredLight::spread(int grid_row, const ScreenLayout& layout) {
  const std::vector<float>& blur = layout.scatter.blur;
  const std::size_t reach = blur.size() / 2;
  const auto y = static_cast<std::size_t>(grid_row);
  if (y < reach || y + reach >= grid_rows_) return;  // a row that only feeds the blur
  for (std::size_t color = 0; color < layout.colors; ++color) {
    std::vector<float> sum(grid_columns_, 0.0f);
    for (std::size_t k = 0; k < blur.size(); ++k)
      add(cells_.data() + cells_at(color, y - reach + k), blur[k], sum);
    float* out = rows_.data() + row_at(color, y);
    for (int column = 0; column < layout.columns.count; ++column) {
      const GridPlace at = place_in(layout.scatter.columns, layout.columns.center_mm(column));
      const float left = sum[at.point], right = sum[at.point + 1];
      out[column] = left + static_cast<float>(at.fraction) * (right - left);
    }
  }
}

void ScatteredLight::add_to(ImageRow& target, const ScreenLayout& layout, int image_row) const {
  const GridPlace at = place_in(layout.scatter.rows, layout.rows.center_mm(image_row));
  const double share = layout.scatter.share;
  for (std::size_t color = 0; color < layout.colors; ++color) {
    const float* row = rows_.data() + row_at(color, at.point);
    target.scattered[color].push_back({row, static_cast<float>(share * (1 - at.fraction))});
    target.scattered[color].push_back({row + stride_, static_cast<float>(share * at.fraction)});
  }
}

}  // namespace tessera::detail
