#include "engine/program/import/model_positions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace tessera::program {
namespace {

/// A model is far from 0 if the center of its bounds is farther away than this many times its extent. Floats
/// have 24 bits; 4096 pixels with 8 bits of subpixels need 20 of them.
constexpr double kFarExtents = 16;

struct Bounds {
  std::array<double, 3> low, high;

  Bounds() {
    low.fill(std::numeric_limits<double>::infinity());
    high.fill(-std::numeric_limits<double>::infinity());
  }
  void add(const Position& p) {
    if (!std::isfinite(p.x + p.y + p.z)) return;
    const std::array<double, 3> at{p.x, p.y, p.z};
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], at[k]);
      high[k] = std::max(high[k], at[k]);
    }
  }
  /// The center, rounded to integers, if it is far from 0; else 0.
  Vec3 far_center() const {
    double distance = 0, extent = 0;
    std::array<double, 3> center{};
    for (std::size_t k = 0; k < 3; ++k) {
      if (!(low[k] <= high[k])) return {};
      center[k] = std::round(low[k] / 2 + high[k] / 2);
      distance = std::max(distance, std::abs(center[k]));
      extent = std::max(extent, high[k] - low[k]);
    }
    if (!(distance > kFarExtents * extent)) return {};
    return {center[0], center[1], center[2]};
  }
};

}  // namespace

void ModelPositions::reserve(std::size_t count) {
  if (are_floats_) floats_.reserve(3 * count);
  else doubles_.reserve(3 * count);
}

std::vector<float> ModelPositions::take_floats(ModelUse use, Vec3& origin) {
  const std::size_t count = size();
  Bounds bounds;
  for (std::size_t i = 0; i < count && use == ModelUse::display; ++i) bounds.add((*this)[i]);
  if (use == ModelUse::display) origin = bounds.far_center();
  std::vector<float> floats = std::exchange(floats_, {});
  const std::vector<double> doubles = std::exchange(doubles_, {});
  const std::array<double, 3> from{origin.x, origin.y, origin.z};
  if (!are_floats_) {
    floats.resize(doubles.size());
    for (std::size_t i = 0; i < doubles.size(); ++i) floats[i] = static_cast<float>(doubles[i] - from[i % 3]);
  } else if (from != std::array<double, 3>{}) {
    for (std::size_t i = 0; i < floats.size(); ++i) floats[i] = static_cast<float>(floats[i] - from[i % 3]);
  }
  return floats;
}

}  // namespace tessera::program
