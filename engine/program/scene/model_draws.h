// Draws of a model's parts.
#pragma once

#include <memory>
#include <vector>

#include "engine/program/import/model.h"
#include "engine/program/scene/scene.h"

namespace tessera::program {

/// Makes textures of Model::textures. Moves the images' pixels into the pictures, which are those of the
/// textures, one each.
std::vector<std::shared_ptr<const Texture>> make_textures(
    Model& model, std::vector<std::shared_ptr<const Picture>>& pictures);

/// Returns the state of a part's draw.
/// @param texture  the part's; null: none
DrawState part_state(const ModelPart& part, const Texture* texture);

/// Whether some alpha of a part is below 1: of its material, its vertices or its image.
/// @param mesh  of the part alone
bool has_alpha(const ModelPart& part, const MeshData& mesh, const Model& model);

/// Adds the meshes, textures and draws of all parts to the scene.
/// - Parts whose alpha is ModelAlpha::mask discard fragments below the cutoff.
/// - Parts that blend are drawn last, without writing depth; their triangles become Scene::blended. A part
///   whose alpha is 1 throughout is opaque.
/// - Lines, points and unlit parts are drawn without lighting.
void add_model_draws(Model model, Scene& scene);

}  // namespace tessera::program
