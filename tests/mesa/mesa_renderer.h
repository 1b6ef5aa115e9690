// A second opinion on every picture: Mesa's llvmpipe, driven through OSMesa. It shares no code with the
// engine, and with the reference renderer only the parsed scene, the table of which vertices make up a face,
// a shadow's projection, and the mipmaps, so that what is compared is how they are filtered.
//
// Flat and Gouraud draws go through OpenGL's fixed functions wherever those can do them; Phong shading and
// what fixed functions cannot do (Phong highlights, more than 8 lights, ...) go through GLSL programs. The
// depth buffer has the scene's own format. Where nothing reads the colour buffer, colours are kept in float
// and become levels or palette entries when the frame is finished, which is the same as at each write;
// blending, logic operations and accumulation have 8 bits a component to work on.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tests/reference/scene.h"

namespace tessera::mesa {

/// Why Mesa cannot follow a scene; nothing if it can.
std::optional<std::string> unsupported(const reference::Scene& scene);

/// Of mipmapped textures: by GLSL, from exact derivatives [GL 2.1, equation 3.14], or as Mesa has it, one for
/// several pixels and rounded.
enum class LevelOfDetail : std::uint8_t { exact, mesas_own };

/// What the colour buffer shows at the end of the frame: 3 bytes a pixel, rows from the top.
/// @throws std::runtime_error if the scene is unsupported or OpenGL reports an error.
std::vector<std::uint8_t> render(const reference::Scene& scene,
                                 LevelOfDetail level_of_detail = LevelOfDetail::exact);

}  // namespace tessera::mesa
