#include "framebuffer/display/scattered_light.h"

#include <algorithm>

namespace tessera::detail {
namespace {

/// Place of a position between the points of a grid.
struct GridPlace {
  std::size_t point;  ///< the point before it
  double fraction;    ///< of the way to the next point
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
  row_count_ = static_cast<std::size_t>(layout.scatter.rows.count);
  stride_ = padded_columns(layout.columns.count);
  values_.resize(layout.colors * row_count_ * stride_);
}

void ScatteredLight::compute(int grid_row, const ScreenLayout& layout, const ScreenRows& light,
                             const LineExposure& exposure) {
  const ResampleTable& table = layout.scatter.vertical;
  const int first = table.first[static_cast<std::size_t>(grid_row)];
  const float* weights = table.weights_of(grid_row);
  for (std::size_t color = 0; color < layout.colors; ++color) {
    std::vector<float> sum(static_cast<std::size_t>(layout.scatter.columns.count), 0.0f);
    for (std::size_t plane = 0; plane < layout.planes.size(); ++plane) {
      if (layout.planes[plane].color != color) continue;
      for (int tap = 0; tap < table.taps; ++tap) {
        const auto line = static_cast<std::size_t>(first + tap);
        const int row = (first + tap) / layout.lines_per_row;
        const float present = exposure.is_whole ? 1 : exposure.present[color][line];
        add(light.present(row, plane) + light.scatter_offset(), weights[tap] * present, sum);
        if (light.has_afterglow())
          add(light.earlier(row, plane) + light.scatter_offset(),
              weights[tap] * exposure.earlier[color][line], sum);
      }
    }
    float* out = row(color, static_cast<std::size_t>(grid_row));
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
    target.scattered[color].push_back({row(color, at.point), static_cast<float>(share * (1 - at.fraction))});
    target.scattered[color].push_back({row(color, at.point + 1), static_cast<float>(share * at.fraction)});
  }
}

}  // namespace tessera::detail
