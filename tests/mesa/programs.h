// GLSL programs for features beyond the fixed-function pipeline: lighting at each vertex or pixel, and
// textures that depend on the level of detail. Programs are composed of parts and compiled on first use.
#pragma once

#include <map>
#include <vector>

#include "context.h"

namespace tessera::mesa {

enum class LightingBy { kFixedFunctions, kVertexProgram, kFragmentProgram };

using Vectors = std::vector<GLfloat>;  ///< four components each

inline void append(Vectors& vectors, reference::Vec4 v) {
  for (const double x : {v.x, v.y, v.z, v.w}) vectors.push_back(static_cast<GLfloat>(x));
}

class Programs {
 public:
  /// @param functions  of the current context; must outlive this object.
  explicit Programs(const Functions& functions) : functions_(functions) {}

  /// Makes a program current, or the fixed-function pipeline.
  ///
  /// @param texturing  whether the program applies textures; ignored for lighting at the pixels
  void use(LightingBy lighting, bool texturing);

  /// Sets a uniform of the current program. No effect without a program or if it lacks the uniform.
  void set(const char* uniform, int value) const;
  void set(const char* uniform, const Vectors& values) const;

 private:
  GLuint made(LightingBy lighting, bool texturing) const;

  const Functions& functions_;
  std::map<std::pair<LightingBy, bool>, GLuint> made_;
  GLuint used_ = 0;
};

}  // namespace tessera::mesa
