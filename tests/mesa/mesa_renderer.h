// Independent renderer for every test scene: Mesa's llvmpipe through OSMesa. It shares no code with the
// engine. With the reference renderer it shares the parsed scene, the table of the vertices of a face, the
// shadow projection, and the mipmaps, so that only their filtering is compared.
//
// Flat and Gouraud draws use OpenGL's fixed-function pipeline where possible. Phong shading, Phong
// highlights, more than 8 lights and the like use GLSL programs. The depth buffer has the scene's format. If
// nothing reads the colour buffer, colours are kept in float and quantized after the frame, which equals
// quantizing at each write. Blending, logic operations and accumulation use 8 bits per component.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tests/reference/scene.h"

namespace tessera::mesa {

/// Why Mesa cannot render a scene; none if it can.
std::optional<std::string> unsupported(const reference::Scene& scene);

/// Level of detail of mipmapped textures. `exact`: by GLSL from exact derivatives [GL 2.1, equation 3.14].
/// `mesas_own`: Mesa's, one for several pixels and rounded.
enum class LevelOfDetail : std::uint8_t { exact, mesas_own };

/// Displayed colours at the end of the frame: 3 bytes per pixel, rows from the bottom.
/// @throws std::runtime_error if the scene is unsupported or OpenGL reports an error.
std::vector<std::uint8_t> render(const reference::Scene& scene,
                                 LevelOfDetail level_of_detail = LevelOfDetail::exact);

}  // namespace tessera::mesa
