// The texture environment on a chunk of pixels. Twin: texture_env_reference() in texture.h.
#if defined(TESSERA_SHADING_TEXTURE_ENV_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TESSERA_SHADING_TEXTURE_ENV_INL_H_
#undef TESSERA_SHADING_TEXTURE_ENV_INL_H_
#else
#define TESSERA_SHADING_TEXTURE_ENV_INL_H_
#endif

#include "shading/fragment_ops-inl.h"
#include "shading/texture.h"

HWY_BEFORE_NAMESPACE();
namespace tessera::detail {
namespace HWY_NAMESPACE {

/// TextureEnv::modulate for textures without alpha, the most common case.
HWY_INLINE Colors modulated(const Colors& f, const Colors& t) {
  return {{hn::Mul(f.c[0], t.c[0]), hn::Mul(f.c[1], t.c[1]), hn::Mul(f.c[2], t.c[2]), f.c[3]}};
}

/// Alpha `f` of the fragment under alpha `t` of the texel.
HWY_INLINE Float texture_env_alpha(const DrawTexture& texture, Float f, Float t) {
  if (!texture.changes_alpha()) return f;
  return texture.function == TextureEnv::replace ? t : hn::Mul(f, t);
}

inline HWY_NOINLINE Colors texture_env_lanes(const DrawTexture& texture, const Colors& f, const Colors& t) {
  const auto each = [&](auto component) HWY_ATTR {
    return Colors{{component(0), component(1), component(2), texture_env_alpha(texture, f.c[3], t.c[3])}};
  };
  switch (texture.function) {
    case TextureEnv::modulate: return each([&](int k) HWY_ATTR { return hn::Mul(f.c[k], t.c[k]); });
    case TextureEnv::replace: return each([&](int k) HWY_ATTR { return t.c[k]; });
    case TextureEnv::decal:
      return each([&](int k) HWY_ATTR { return mul_add(t.c[3], hn::Sub(t.c[k], f.c[k]), f.c[k]); });
    case TextureEnv::blend:
      return each([&](int k) HWY_ATTR {
        return mul_add(t.c[k], hn::Sub(splat(texture.constant[static_cast<std::size_t>(k)]), f.c[k]), f.c[k]);
      });
    default: return each([&](int k) HWY_ATTR { return hn::Min(hn::Add(f.c[k], t.c[k]), splat(1.0f)); });
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera::detail
HWY_AFTER_NAMESPACE();

#endif
