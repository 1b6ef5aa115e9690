#include "texture_env.h"

#include "lighting.h"

namespace tessera::reference {
namespace {

Vec4 with_alpha(Vec3 color, double alpha) { return {color.x, color.y, color.z, alpha}; }

}  // namespace

// The alpha of a texel without alpha is 1: where the tables multiply by it, they need no columns of their
// own.
Vec4 textured(TextureEnv env, Vec4 fragment, Vec4 texel, int channels, Vec4 constant) {
  const bool has_alpha = channels == 2 || channels == 4;
  const Vec3 f = xyz(fragment), t = xyz(texel), c = xyz(clamp01(constant)), one{1, 1, 1};
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
