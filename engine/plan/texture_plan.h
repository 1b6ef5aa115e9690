// What a draw's texture comes to: nothing, a colour that is worked into the vertices' colours, or texels at
// each pixel.
#pragma once

#include <cstdint>

#include "engine/record/recording.h"
#include "shading/effect_notes.h"
#include "shading/texture.h"

namespace tessera::detail {

struct TexturePlan {
  enum class Use : std::uint8_t { none, one_color, texels } use = Use::none;
  DrawTexture texture;  ///< but for the attribute

  /// One colour changes colours in a way that may come before they are interpolated, where none is
  /// extrapolated and cut: all but a sum that is cut at 1.
  bool is_affine() const { return use == Use::one_color && texture.function != TextureEnv::add; }
};

/// What a draw has texels for.
struct TextureNeeds {
  bool colors = true;  ///< of some face are colours, not indices, and stored
  bool alpha = false;  ///< is looked at: by the alpha test, by blending, or stored
};

/// @param notes  receives the use of the texels, or why they are skipped; the caller notes the use of a
/// single
///               colour
TexturePlan plan_texture(const RecordedDraw& draw, const TextureNeeds& needs, const EffectNotes& notes);

}  // namespace tessera::detail
