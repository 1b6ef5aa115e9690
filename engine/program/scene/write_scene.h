// Writes the scene of a model as a scene file of format version 1.
#pragma once

#include <string>

#include "engine/program/scene/scene.h"

namespace tessera::program {

/// Writes NAME.json, and the textures next to it as NAME.texture0.png, NAME.texture1.png, ... Existing files
/// are replaced.
/// - The file gives the same picture, bit for bit: its numbers are read back as the same floats.
/// - Each draw has its own mesh, with only the vertices and attributes that it uses. Triangles that blend
/// keep
///   their order, and the light over the viewer's shoulder its place: both fit the camera of the scene.
/// - Primitives with positions that are not finite, which are not drawn, are left out.
/// @param scene  made by model_scene(); size, camera and lights may have been overridden
/// @param path   of the scene file; ends in ".json"
/// @throws Error for a file that cannot be written, and for a vertex whose normal, colour or texture
/// coordinates
///   are not finite
void write_scene(const Scene& scene, const std::string& path);

}  // namespace tessera::program
