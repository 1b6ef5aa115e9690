// The scene's textures, and which of them a draw gets.
#pragma once

#include <vector>

#include "context.h"

namespace tessera::mesa {

/// Where programs find a texture: OpenGL allows a unit one kind of sampler at a time.
inline constexpr int kImageUnit = 0;  ///< 2-D; fixed functions look here for both
inline constexpr int kRowUnit = 1;    ///< 1-D

/// One row high: OpenGL's 1-D texture, of which t has no say.
inline bool is_row(const reference::Texture& texture) { return texture.image.height == 1; }

class Textures {
 public:
  /// @param functions  of the current context; it and the scene must outlive this.
  Textures(const Functions& functions, const reference::Scene& scene)
      : functions_(functions), textures_(scene.textures), names_(scene.textures.size()) {}

  /// Binds the draw's texture and sets fixed functions to its environment; without one, turns texturing off.
  void use(const reference::Draw& draw);

  void use_none();

 private:
  GLuint uploaded(std::size_t number);

  const Functions& functions_;
  const std::vector<reference::Texture>& textures_;
  std::vector<GLuint> names_;  // 0: not uploaded yet
};

}  // namespace tessera::mesa
