// Models far from the origin: coordinates relative to a centre, before they become floats.
#pragma once

#include <array>
#include <vector>

#include "engine/program/import/model.h"

namespace tessera::program {

/// The point to subtract from coordinates: the centre of their bounds, rounded to integers, if floats would
/// lose more than a hundredth of a pixel: if the centre is more than 16 times as far away as the bounds are
/// wide. Else 0 0 0, so that coordinates stay as they are. Positions that are not finite are ignored.
Vec3 origin_for(const std::vector<std::array<double, 3>>& positions);

/// Appends positions as floats, relative to the origin.
void append_relative(const std::vector<std::array<double, 3>>& positions, const Vec3& origin,
                     std::vector<float>& to);

/// Moves cameras and lights of the file to the model's origin.
void move_view_to_origin(Model& model);

}  // namespace tessera::program
