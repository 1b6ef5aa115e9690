// Applies the caps of a Quality to what a draw asks for. Everything that follows reads the capped values.
#pragma once

#include <algorithm>

#include "engine/tessera/quality.hpp"
#include "engine/tessera/scene.hpp"
#include "engine/tessera/state.hpp"

namespace tessera::detail {

inline Shading capped(Shading asked, ShadingCap cap) {
  static_assert(Shading::flat < Shading::gouraud && Shading::gouraud < Shading::phong);
  switch (cap) {
    case ShadingCap::gouraud: return std::min(asked, Shading::gouraud);
    case ShadingCap::flat: return Shading::flat;
    default: return asked;
  }
}

inline LightModel capped(LightModel asked, ViewerCap cap) {
  if (cap == ViewerCap::infinite) asked.local_viewer = false;
  return asked;
}

inline TextureSampler capped(TextureSampler asked, TextureCap cap) {
  if (cap == TextureCap::nearest) asked.mag = asked.min = TextureFilter::nearest;
  if (cap != TextureCap::bilinear) return asked;
  switch (asked.min) {
    case TextureFilter::nearest_mipmap_nearest:
    case TextureFilter::nearest_mipmap_linear: asked.min = TextureFilter::nearest; break;
    case TextureFilter::linear_mipmap_nearest:
    case TextureFilter::linear_mipmap_linear: asked.min = TextureFilter::linear; break;
    default: break;
  }
  return asked;
}

}  // namespace tessera::detail
