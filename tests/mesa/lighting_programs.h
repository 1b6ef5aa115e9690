// Lighting by GLSL programs: at each vertex or at each pixel, the specification's equation with its special cases.
#pragma once

#include <vector>

#include "context.h"

namespace tessera::mesa {

/// As many lights as a program takes.
inline constexpr std::size_t kMaxProgramLights = 32;

class LightingPrograms {
 public:
  /// @param functions  of the current context, which must outlive this.
  explicit LightingPrograms(const Functions& functions) : functions_(functions) {}

  /// Makes the program for this lit draw current and sets its uniforms. Two-sided lighting at the vertices wants
  /// GL_VERTEX_PROGRAM_TWO_SIDE, which this sets too. Lights go into eye space by the camera. Lighting at the vertices leaves
  /// texturing to fixed functions.
  ///
  /// @param texture  the draw's, bound by Textures::use(); null: none
  void use(const reference::Draw& draw, const reference::LightModel& model, const std::vector<reference::Light>& lights, const reference::Camera& camera,
           bool has_vertex_colors, const reference::Texture* texture);

 private:
  GLuint program(bool at_each_pixel);

  const Functions& functions_;
  GLuint at_vertices_ = 0, at_pixels_ = 0;  // made when first wanted
};

}  // namespace tessera::mesa
