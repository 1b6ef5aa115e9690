// Models far from the origin: coordinates relative to a centre, before they become floats.
#pragma once

#include <array>
#include <limits>
#include <vector>

#include "engine/program/import/model.h"

namespace tessera::program {

/// The bounds of positions. Those that are not finite are ignored.
class PositionBounds {
 public:
  void add(double x, double y, double z);

  /// The point to subtract from coordinates: the centre of the bounds, rounded to integers, if it is more
  /// than 16 times as far away as the bounds are wide. Else 0 0 0, so that coordinates stay as they are.
  /// Floats have 24 bits; 4096 pixels with 8 bits of subpixels need 20 of them.
  Vec3 origin() const;

 private:
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();
  std::array<double, 3> low_{kInfinity, kInfinity, kInfinity}, high_{-kInfinity, -kInfinity, -kInfinity};
};

/// PositionBounds::origin() of all positions.
Vec3 origin_for(const std::vector<std::array<double, 3>>& positions);

/// Appends positions as floats, relative to the origin.
void append_relative(const std::vector<std::array<double, 3>>& positions, const Vec3& origin,
                     std::vector<float>& to);

/// Moves cameras and lights of the file to the model's origin.
void move_view_to_origin(Model& model);

}  // namespace tessera::program
