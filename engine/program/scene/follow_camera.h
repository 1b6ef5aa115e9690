// Parts of a model's scene that depend on its camera.
#pragma once

#include "engine/program/scene/scene.h"

namespace tessera::program {

/// Adapts a scene to its camera, after the camera was set or changed:
/// - Scene::has_shoulder_light: moves the light over the left shoulder of the viewer.
/// - Scene::blended: sorts the triangles from back to front by the distance of their centres along the
///   direction of view, and replaces their draws, the last ones of the frame. Triangles at equal distances
///   keep the order of the model.
void follow_camera(Scene& scene);

}  // namespace tessera::program
