// Shaders in which every constant stands as a literal: Debian's llvmpipe reads uniforms by scalar gathers,
// which costs it up to 2.7 times as much.
#pragma once

#include <vector>

#include "engine/tessera/tessera.hpp"
#include "perf/bench/gl_workload.h"

namespace tessera::rivals {

/// Positions stand in clip space already.
enum class Varying { nothing, colors, texcoords };
/// @param color  of all, where nothing varies
bench::ShaderSources window_shaders(Varying varying, const Color& color = {});

/// A draw under the lighting equation, as Tessera has it.
struct LitDraw {
  Camera camera{};
  Matrix transform{};  ///< world from object: moves and turns, and scales alike in all directions
  std::vector<Light> lights{};
  LightModel model{};  ///< of one side
  Material material{};
  Shading shading = Shading::gouraud;
  bool normalizes = true;  ///< normals of vertices
};
/// @throws std::runtime_error for what these shaders do not know
bench::ShaderSources lit_shaders(const LitDraw& form);

}  // namespace tessera::rivals
