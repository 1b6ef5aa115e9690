#include "engine/program/import/model_origin.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tessera::program {

Vec3 origin_for(const std::vector<std::array<double, 3>>& positions) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  std::array<double, 3> low{kInfinity, kInfinity, kInfinity}, high{-kInfinity, -kInfinity, -kInfinity};
  for (const std::array<double, 3>& p : positions) {
    if (!std::isfinite(p[0] + p[1] + p[2])) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], p[k]);
      high[k] = std::max(high[k], p[k]);
    }
  }
  std::array<double, 3> center{};
  double extent = 0, distance = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    center[k] = std::round((low[k] + high[k]) / 2);
    extent = std::max(extent, high[k] - low[k]);
    distance = std::max(distance, std::abs(center[k]));
  }
  constexpr double kFar = 16;
  if (!std::isfinite(distance) || !(distance > kFar * extent)) return {};
  return {center[0], center[1], center[2]};
}

void append_relative(const std::vector<std::array<double, 3>>& positions, const Vec3& origin,
                     std::vector<float>& to) {
  to.reserve(to.size() + 3 * positions.size());
  for (const std::array<double, 3>& p : positions)
    to.insert(to.end(), {static_cast<float>(p[0] - origin.x), static_cast<float>(p[1] - origin.y),
                         static_cast<float>(p[2] - origin.z)});
}

void move_view_to_origin(Model& model) {
  const double origin[3] = {model.origin.x, model.origin.y, model.origin.z};
  for (ModelCamera& camera : model.cameras)
    for (std::size_t row = 0; row < 3; ++row)
      for (std::size_t k = 0; k < 3; ++k)
        camera.view.m[4 * row + 3] += camera.view.m[4 * row + k] * origin[k];
  for (Light& light : model.lights)
    for (std::size_t k = 0; k < 3; ++k)
      if (light.position[3] != 0) light.position[k] -= static_cast<float>(origin[k]);
}

}  // namespace tessera::program
