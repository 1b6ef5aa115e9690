// Colours of a chunk of pixels under their texels. Twin: textured_color() in texture.h.
#if defined(TESSERA_SHADING_TEXTURE_ENV_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TESSERA_SHADING_TEXTURE_ENV_INL_H_
#undef TESSERA_SHADING_TEXTURE_ENV_INL_H_
#else
#define TESSERA_SHADING_TEXTURE_ENV_INL_H_
#endif

#include "shading/fragment_ops-inl.h"
#include "shading/texture.h"

HWY_BEFORE_NAMESPACE();
namespace tessera {
namespace HWY_NAMESPACE {

inline HWY_NOINLINE Colors textured_lanes(const DrawTexture& texture, const Colors& f, const Colors& t) {
  Colors c = f;
  for (int k = 0; k < 3; ++k) {
    switch (texture.function) {
      case TextureFunction::modulate: c.c[k] = hn::Mul(f.c[k], t.c[k]); break;
      case TextureFunction::replace: c.c[k] = t.c[k]; break;
      case TextureFunction::decal: c.c[k] = mul_add(t.c[3], hn::Sub(t.c[k], f.c[k]), f.c[k]); break;
      case TextureFunction::blend: c.c[k] = mul_add(t.c[k], hn::Sub(splat(texture.constant[static_cast<std::size_t>(k)]), f.c[k]), f.c[k]); break;
      case TextureFunction::add: c.c[k] = hn::Min(hn::Add(f.c[k], t.c[k]), splat(1.0f)); break;
    }
  }
  if (texture.changes_alpha()) c.c[3] = texture.function == TextureFunction::replace ? t.c[3] : hn::Mul(f.c[3], t.c[3]);
  return c;
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera
HWY_AFTER_NAMESPACE();

#endif
