// The scene's textures, and their binding for draws.
#pragma once

#include <vector>

#include "context.h"

namespace tessera::mesa {

/// Texture units of programs: OpenGL allows one kind of sampler per unit.
inline constexpr int kImageUnit = 0;  ///< 2-D; the fixed-function pipeline uses this unit for both kinds
inline constexpr int kRowUnit = 1;    ///< 1-D

/// An image one row high is OpenGL's 1-D texture; t is ignored.
inline bool is_row(const reference::Texture& texture) { return texture.image.height == 1; }

class Textures {
 public:
  /// @param functions  of the current context; it and the scene must outlive this object.
  Textures(const Functions& functions, const reference::Scene& scene)
      : functions_(functions), textures_(scene.textures), names_(scene.textures.size()) {}

  /// Binds the draw's texture and sets the fixed-function environment; without a texture, disables texturing.
  void use(const reference::Draw& draw);

  void use_none();

 private:
  GLuint uploaded(std::size_t number);

  const Functions& functions_;
  const std::vector<reference::Texture>& textures_;
  std::vector<GLuint> names_;  // 0: not uploaded
};

}  // namespace tessera::mesa
