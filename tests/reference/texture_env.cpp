#include "texture_env.h"

#include "lighting.h"

namespace tessera::reference {
namespace {

Vec4 with_alpha(Vec3 color, double alpha) { return {color.x, color.y, color.z, alpha}; }

}  // namespace

// A texel without alpha has alpha 1. Where the tables multiply by it, formats without alpha need no separate
// columns.
Vec4 textured(TextureEnv env, Vec4 fragment, Vec4 texel, int channels, Vec4 constant) {
  const bool has_alpha = channels == 2 || channels == 4;
  const Vec3 f = xyz(fragment);
  const Vec3 t = xyz(texel);
  const Vec3 c = xyz(clamp01(constant));
  const Vec3 one{1, 1, 1};
  switch (env) {
    case TextureEnv::kModulate: return with_alpha(f * t, fragment.w * texel.w);
    case TextureEnv::kReplace: return with_alpha(t, has_alpha ? texel.w : fragment.w);
    case TextureEnv::kDecal: return with_alpha((1 - texel.w) * f + texel.w * t, fragment.w);
    case TextureEnv::kBlend: return with_alpha(f * (one - t) + c * t, fragment.w * texel.w);
    case TextureEnv::kAdd: return clamp01(with_alpha(f + t, fragment.w * texel.w));
  }
  return fragment;
}

}  // namespace tessera::reference
