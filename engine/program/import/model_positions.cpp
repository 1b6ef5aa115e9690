#include "engine/program/import/model_positions.h"

#include <array>
#include <utility>

#include "engine/program/import/model_origin.h"

namespace tessera::program {
void ModelPositions::reserve(std::size_t count) {
  if (are_floats_) floats_.reserve(3 * count);
  else doubles_.reserve(3 * count);
}

std::vector<float> ModelPositions::take_floats(ModelUse use, Vec3& origin) {
  const std::size_t count = size();
  PositionBounds bounds;
  for (std::size_t i = 0; i < count && use == ModelUse::display; ++i) {
    const auto& [x, y, z] = (*this)[i];
    bounds.add(x, y, z);
  }
  if (use == ModelUse::display) origin = bounds.origin();
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
