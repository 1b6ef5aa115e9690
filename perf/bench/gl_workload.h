// A drawing as OpenGL draws it at its fastest: one mesh in one call, constants as literals in its shaders,
// nothing that changes inside a frame.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/program/scene/mesh_data.h"
#include "engine/tessera/tessera.hpp"

namespace tessera::bench {
using namespace program;

/// GLSL 3.30. Vertices come as `layout(location = ...) in`: 0 position, 1 normal, 2 colour, 3 texture
/// coordinates.
struct ShaderSources {
  std::string vertex, fragment;
};

struct GlWorkload {
  MeshData mesh{};
  ShaderSources shaders{};
  bool tests_depth = false;  ///< less, and writes it
  bool writes_color = true;
  int revealed_indices = 0;  ///< the last of them, which are drawn once more to be judged, in colour, where
                             ///< the depth is equal to theirs; 0: none are
  bool blends = false;       ///< by the source's alpha
  bool increments_stencil = false;  ///< cleared to 1; passes where it is greater than 0, and counts up
  bool culls_back = false;
  Color clear_color{0, 0, 0, 1};
  int texture_size = 0;                ///< texels along both sides; 0: there is none
  std::vector<std::uint8_t> texels{};  ///< RGBA, rows from the bottom
  TextureSampler sampler{};
  double max_mismatch_share = 0.001;  ///< share of pixels that may be more than two levels off
};

}  // namespace tessera::bench
