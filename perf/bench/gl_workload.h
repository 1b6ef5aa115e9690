// A workload for OpenGL, in its fastest form: one mesh in one call, constants as literals in the shaders, no
// state changes within a frame. Workloads that are about many draws have one call and two uniforms each.
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

/// A draw of the whole mesh with its own constants: `uniform mat4 clip_from_object; uniform vec3 color;`.
struct GlDraw {
  Matrix clip_from_object{};
  Color color{};
};

/// State is OpenGL's default except for the members below.
struct GlWorkload {
  MeshData mesh{};
  ShaderSources shaders{};
  std::vector<GlDraw> draws{};  ///< one call each; empty: one call without uniforms
  int samples = 1;              ///< per pixel; more than 1: a multisample buffer, resolved into the picture
  int width = 0, height = 0;    ///< pixels; 0: the size of the workload's set-up
  bool tests_depth = false;     ///< depth function GL_LESS, with writes
  bool writes_color = true;
  /// Checked frames draw the last `revealed_indices` indices once more, with colour writes and depth function
  /// GL_EQUAL: the picture then shows whether their depth was stored. 0: none.
  int revealed_indices = 0;
  bool blends = false;  ///< GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA
  /// Stencil is cleared to 1. Fragments pass if it is greater than 0, and increment it.
  bool increments_stencil = false;
  bool culls_back = false;
  Color clear_color{0, 0, 0, 1};
  int texture_size = 0;                ///< texels per side; 0: no texture
  std::vector<std::uint8_t> texels{};  ///< RGBA, bottom row first
  TextureSampler sampler{};
  double max_mismatch_share = 0.001;  ///< allowed share of pixels that differ by more than two levels
};

}  // namespace tessera::bench
