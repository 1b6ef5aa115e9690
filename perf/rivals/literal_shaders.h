// GLSL shaders with all constants as literals. Debian's llvmpipe reads uniforms by scalar gathers: shaders
// with uniforms are up to 2.7 times slower.
#pragma once

#include <vector>

#include "engine/tessera/tessera.hpp"
#include "perf/bench/gl_workload.h"

namespace tessera::rivals {

/// Vertex attribute that gives fragments their colour.
enum class Varying {
  nothing,   ///< one colour for all fragments
  colors,    ///< interpolated vertex colours
  texcoords  ///< texture coordinates
};
/// Unlit shaders for vertices whose positions are in clip space.
/// @param color  colour of all fragments; Varying::nothing only
bench::ShaderSources window_shaders(Varying varying, const Color& color = {});

/// A draw with Tessera's lighting equation.
struct LitDraw {
  Camera camera{};
  Matrix transform{};  ///< world_from_object: rotation, translation and uniform scale only
  std::vector<Light> lights{};
  LightModel model{};  ///< one-sided
  Material material{};
  Shading shading = Shading::gouraud;
  bool is_textured = false;  ///< the texture's colour times the lit one; per-vertex lighting only
  bool normalizes = true;    ///< normalizes vertex normals in eye space (DrawState::normalize)
};
/// Draws of GlWorkload::draws, lit by one white light at the viewer: colour * (ambient + cosine).
/// Matrices scale uniformly and do not rotate, so that normals stay as they are.
bench::ShaderSources object_shaders(double ambient);
/// @throws std::runtime_error for two-sided lighting and for highlights other than Blinn's
bench::ShaderSources lit_shaders(const LitDraw& draw);

}  // namespace tessera::rivals
