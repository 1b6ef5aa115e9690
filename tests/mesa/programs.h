// GLSL programs for what fixed functions cannot do: lighting at each vertex or at each pixel, and textures
// whose level of detail has a say. Every program is made of parts and made when first wanted.
#pragma once

#include <map>
#include <vector>

#include "context.h"

namespace tessera::mesa {

enum class LightingBy { kFixedFunctions, kVertexProgram, kFragmentProgram };

using Vectors = std::vector<GLfloat>;  ///< four numbers each

inline void append(Vectors& vectors, reference::Vec4 v) {
  for (const double x : {v.x, v.y, v.z, v.w}) vectors.push_back(static_cast<GLfloat>(x));
}

class Programs {
 public:
  /// @param functions  of the current context, which must outlive this.
  explicit Programs(const Functions& functions) : functions_(functions) {}

  /// Makes a program current, or fixed functions alone.
  ///
  /// @param texturing  whether a program applies textures; lighting at the pixels leaves no choice
  void use(LightingBy lighting, bool texturing);

  /// Set a uniform of the program in use, if there is one and it has it.
  void set(const char* uniform, int value) const;
  void set(const char* uniform, const Vectors& values) const;

 private:
  GLuint made(LightingBy lighting, bool texturing) const;

  const Functions& functions_;
  std::map<std::pair<LightingBy, bool>, GLuint> made_;
  GLuint used_ = 0;
};

}  // namespace tessera::mesa
