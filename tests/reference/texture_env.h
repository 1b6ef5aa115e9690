// Texture environments.
#pragma once

#include "scene.h"

namespace tessera::reference {

/// Applies OpenGL 1.5's tables 3.22 and 3.23 and clamps to 0..1. Undefined there: decal with one and two
/// channels, which works like three and four.
/// @param texel  as returned by TextureSampler::sample()
/// @param channels  of the texture: luminance, luminance and alpha, RGB, RGBA
/// @param constant  for kBlend
Vec4 textured(TextureEnv env, Vec4 fragment, Vec4 texel, int channels, Vec4 constant);

}  // namespace tessera::reference
