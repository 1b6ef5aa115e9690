#include "engine/program/import/model_origin.h"

#include <algorithm>
#include <cmath>

namespace tessera::program {

void PositionBounds::add(double x, double y, double z) {
  if (!std::isfinite(x + y + z)) return;
  const std::array<double, 3> at{x, y, z};
  for (std::size_t k = 0; k < 3; ++k) {
    low_[k] = std::min(low_[k], at[k]);
    high_[k] = std::max(high_[k], at[k]);
  }
}

Vec3 PositionBounds::origin() const {
  constexpr double kFarExtents = 16;
  double distance = 0, extent = 0;
  std::array<double, 3> center{};
  for (std::size_t k = 0; k < 3; ++k) {
    if (!(low_[k] <= high_[k])) return {};
    center[k] = std::round(low_[k] / 2 + high_[k] / 2);
    distance = std::max(distance, std::abs(center[k]));
    extent = std::max(extent, high_[k] - low_[k]);
  }
  if (!(distance > kFarExtents * extent)) return {};
  return {center[0], center[1], center[2]};
}

Vec3 origin_for(const std::vector<std::array<double, 3>>& positions) {
  PositionBounds bounds;
  for (const auto& [x, y, z] : positions) bounds.add(x, y, z);
  return bounds.origin();
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
