// A drawing in the form that OpenGL draws fastest: one mesh in one call, constants as literals in the
// shaders, no state changes within a frame.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/program/scene/mesh_data.h"
#include "engine/tessera/tessera.hpp"

namespace tessera::bench {
using namespace program;

/// GLSL 3.30. Vertex attribute locations: 0 position, 1 normal, 2 colour, 3 texture coordinates.
struct ShaderSources {
  std::string vertex, fragment;
};

struct GlWorkload {
  MeshData mesh{};
  ShaderSources shaders{};
  bool tests_depth = false;  ///< depth function GL_LESS, with writes
  bool writes_color = true;
  /// Number of trailing indices that a checked frame draws once more, in colour, with GL_EQUAL: makes depth
  /// visible. 0: none.
  int revealed_indices = 0;
  bool blends = false;              ///< GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA
  bool increments_stencil = false;  ///< cleared to 1; passes if greater than 0, then increments
  bool culls_back = false;
  Color clear_color{0, 0, 0, 1};
  int texture_size = 0;                ///< texels per side; 0: no texture
  std::vector<std::uint8_t> texels{};  ///< RGBA, bottom row first
  TextureSampler sampler{};
  double max_mismatch_share = 0.001;  ///< allowed share of pixels that differ by more than two levels
};

}  // namespace tessera::bench
