// Scalar twin of nearest_centers().
#pragma once

#include <cstddef>

#include "framebuffer/nearest_center.h"

namespace tessera::detail {

/// Specification of nearest_centers().
inline NearestCenters nearest_centers_reference(const ColorPoints& points, const ColorPoints& centers) {
  NearestCenters result;
  for (std::size_t i = 0; i < points.padded_size(); ++i) {
    std::uint32_t nearest = 0;
    float nearest_distance = 0;
    for (std::size_t k = 0; k < centers.count; ++k) {
      const float dl = points.l[i] - centers.l[k];
      const float da = points.a[i] - centers.a[k];
      const float db = points.b[i] - centers.b[k];
      const float distance = dl * dl + da * da + db * db;
      if (k == 0 || distance < nearest_distance) {
        nearest_distance = distance;
        nearest = static_cast<std::uint32_t>(k);
      }
    }
    result.center.push_back(nearest);
    result.squared_distance.push_back(nearest_distance);
  }
  return result;
}

}  // namespace tessera::detail
