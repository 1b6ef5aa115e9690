// Use of a draw's texture: none, one colour that is folded into the colours of the draw, or texels per pixel.
#pragma once

#include <cstdint>

#include "engine/record/recording.h"
#include "shading/effect_notes.h"
#include "shading/texture.h"

namespace tessera::detail {

struct TexturePlan {
  enum class Use : std::uint8_t { none, one_color, texels } use = Use::none;
  DrawTexture texture;  ///< complete except for the attribute

  /// The one colour may be applied before interpolation, provided that no colour is extrapolated and clamped.
  /// False for TextureEnv::add, whose sum is clamped at 1.
  bool is_affine() const { return use == Use::one_color && texture.function != TextureEnv::add; }
};

/// Results of texturing that a draw uses.
struct TextureNeeds {
  bool colors = true;  ///< a face stores colours, not indices
  bool alpha = false;  ///< alpha is tested, blended with, or stored
};

/// @param notes  receives the use of texels, or the reason why they are skipped; the caller notes textures
///               of one colour
TexturePlan plan_texture(const RecordedDraw& draw, const TextureNeeds& needs, const EffectNotes& notes);

}  // namespace tessera::detail
