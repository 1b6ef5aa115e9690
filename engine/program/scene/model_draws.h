// Draws of a model's parts.
#pragma once

#include "engine/program/import/model.h"
#include "engine/program/scene/scene.h"

namespace tessera::program {

/// Adds the meshes, textures and draws of all parts to the scene.
/// - Parts whose alpha is ModelAlpha::mask discard fragments below the cutoff.
/// - Parts that blend are drawn last, without writing depth; their triangles become Scene::blended. A part
///   whose alpha is 1 throughout is opaque.
/// - Lines, points and unlit parts are drawn without lighting.
void add_model_draws(Model model, Scene& scene);

}  // namespace tessera::program
