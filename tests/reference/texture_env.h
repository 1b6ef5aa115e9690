// How a texture changes the colour of a fragment.
#pragma once

#include "scene.h"

namespace tessera::reference {

/// By OpenGL 1.5's tables 3.22 and 3.23, clamped to 0..1. What they leave undefined, decal of one and two
/// channels, is that of three and four.
/// @param texel  as TextureSampler::sample() gives it
/// @param channels  of the texture: luminance, luminance and alpha, RGB, RGBA
/// @param constant  of kBlend
Vec4 textured(TextureEnv env, Vec4 fragment, Vec4 texel, int channels, Vec4 constant);

}  // namespace tessera::reference
