// Pictures of a scene from all sides.
#pragma once

#include "engine/program/scene/scene.h"

namespace tessera::program {

/// Turns all cameras and lights of a scene around the vertical axis through the centre of what it draws: as
/// if the scene turned counter-clockwise, seen from above, in front of a camera and under lights that stand
/// still.
void turn_viewer(double degrees, Scene& scene);

}  // namespace tessera::program
