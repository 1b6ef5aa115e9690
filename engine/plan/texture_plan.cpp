#include "engine/plan/texture_plan.h"

#include "shading/fragment_scalar.h"

namespace tessera::detail {
namespace {

/// A texture of one colour leaves the components that matter unchanged.
bool changes_nothing(const DrawTexture& texture, const TextureNeeds& needs) {
  const auto [r, g, b, a] = texture.texel;
  const bool white = r == 1 && g == 1 && b == 1;
  const bool black = r == 0 && g == 0 && b == 0;
  const bool changes_alpha = texture.changes_alpha() && (texture.function == TextureEnv::replace || a != 1);
  if (needs.alpha && changes_alpha) return false;
  if (!needs.colors) return true;
  switch (texture.function) {
    case TextureEnv::modulate: return white;
    case TextureEnv::replace: return false;
    case TextureEnv::decal: return a == 0;
    default: return black;
  }
}

bool is_capped(const TextureSampler& sampler, const TextureSampler& asked) {
  return sampler.mag != asked.mag || sampler.min != asked.min;
}

}  // namespace

TexturePlan plan_texture(const RecordedDraw& draw, const TextureNeeds& needs, const EffectNotes& notes) {
  TexturePlan plan;
  if (draw.texture == nullptr) return plan;
  const TextureState& state = *draw.texture;
  const TextureCap cap = draw.scene_state->quality.texture;
  const FilteredTexture& filtered = state.under(cap);
  DrawTexture& texture = plan.texture;
  texture.function = draw.state.texture_env;
  texture.has_alpha = state.has_alpha();
  const Color& c = draw.state.texture_env_color;
  texture.constant = {clamp_unit(c.r), clamp_unit(c.g), clamp_unit(c.b)};
  if (!needs.colors && !(needs.alpha && texture.changes_alpha())) {
    notes.skipped(Effect::texture, EffectReason::color_and_alpha_unused);
    return plan;
  }
  if (state.one_color || !draw.mesh.has_texcoords()) {
    texture.texel = state.one_color ? *state.one_color : filtered.at_origin;
    if (!state.one_color) notes.skipped(Effect::texture_coordinates, EffectReason::not_in_mesh);
    if (changes_nothing(texture, needs)) notes.skipped(Effect::texture, EffectReason::no_effect);
    else plan.use = TexturePlan::Use::one_color;
    return plan;
  }
  plan.use = TexturePlan::Use::texels;
  texture.levels = &filtered.levels;
  notes.add({.effect = Effect::texture,
             .width = filtered.levels.level[0].width,
             .height = filtered.levels.level[0].height,
             .channels = state.channels});
  if (filtered.levels.needs_footprint()) notes.active(Effect::texture_lod);
  if (is_capped(filtered.sampler, state.under(TextureCap::as_asked).sampler))
    notes.active(Effect::texture_filter, EffectReason::capped);
  return plan;
}

}  // namespace tessera::detail
