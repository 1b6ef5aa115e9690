// Shaders with all constants as literals: Debian's llvmpipe reads uniforms by scalar gathers, which makes it
// up to 2.7 times slower.
#pragma once

#include <vector>

#include "engine/tessera/tessera.hpp"
#include "perf/bench/gl_workload.h"

namespace tessera::rivals {

enum class Varying { nothing, colors, texcoords };
/// Shaders for positions in clip space.
/// @param color  colour of all fragments with Varying::nothing
bench::ShaderSources window_shaders(Varying varying, const Color& color = {});

/// A draw with Tessera's lighting equation.
struct LitDraw {
  Camera camera{};
  Matrix transform{};  ///< world_from_object: rotation, translation and uniform scale only
  std::vector<Light> lights{};
  LightModel model{};  ///< one-sided
  Material material{};
  Shading shading = Shading::gouraud;
  bool normalizes = true;  ///< whether vertex normals are normalized
};
/// @throws std::runtime_error for two-sided lighting and for highlights other than Blinn's
bench::ShaderSources lit_shaders(const LitDraw& draw);

}  // namespace tessera::rivals
