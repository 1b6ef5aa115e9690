#include "engine/plan/texture_plan.h"

#include "shading/fragment_scalar.h"

namespace tessera::detail {
namespace {

const char* name_of(TextureEnv env) {
  switch (env) {
    case TextureEnv::modulate: return "modulates";
    case TextureEnv::replace: return "replaces";
    case TextureEnv::decal: return "decal";
    case TextureEnv::blend: return "blends";
    default: return "adds";
  }
}

const char* name_of(TextureFilter filter) {
  switch (filter) {
    case TextureFilter::nearest: return "nearest";
    case TextureFilter::linear: return "linear";
    case TextureFilter::nearest_mipmap_nearest: return "nearest_mipmap_nearest";
    case TextureFilter::linear_mipmap_nearest: return "linear_mipmap_nearest";
    case TextureFilter::nearest_mipmap_linear: return "nearest_mipmap_linear";
    default: return "linear_mipmap_linear";
  }
}

std::string described(const TextureState& texture) {
  const TextureLevel& level = texture.levels.level[0];
  return std::to_string(level.width) + "x" + std::to_string(level.height) + ", " +
         std::to_string(texture.channels) + (texture.channels == 1 ? " channel" : " channels");
}

// One texel everywhere leaves all that is needed of every colour as it is.
bool changes_nothing(const DrawTexture& texture, bool color_matters, bool alpha_matters) {
  const auto [r, g, b, a] = texture.texel;
  const bool white = r == 1 && g == 1 && b == 1, black = r == 0 && g == 0 && b == 0;
  if (alpha_matters && texture.changes_alpha() && (texture.function == TextureEnv::replace || a != 1))
    return false;
  if (!color_matters) return true;
  switch (texture.function) {
    case TextureEnv::modulate: return white;
    case TextureEnv::replace: return false;
    case TextureEnv::decal: return a == 0;
    default: return black;
  }
}

}  // namespace

TexturePlan plan_texture(const RecordedDraw& draw, const TextureNeeds& needs, std::string* reasons) {
  TexturePlan plan;
  const auto note = [&](const char* line) {
    if (reasons) (*reasons += "  texture").append(line) += "\n";
  };
  if (draw.texture == nullptr) return plan;
  const TextureState& state = *draw.texture;
  DrawTexture& texture = plan.texture;
  texture.function = draw.state.texture_env;
  texture.has_alpha = state.has_alpha();
  const Color& c = draw.state.texture_env_color;
  texture.constant = {clamp_unit(c.r), clamp_unit(c.g), clamp_unit(c.b)};
  if (!needs.colors && !(needs.alpha && texture.changes_alpha())) {
    note(draw.state.alpha_test ? " left out: no colour is stored, and alpha stays what it is"
                               : " left out: no colour is stored, or indices are");
    return plan;
  }
  if (state.one_color || !draw.mesh.texcoords) {
    texture.texel = state.one_color ? *state.one_color : state.at_origin;
    if (!state.one_color) note(": the mesh has no texture coordinates");
    if (changes_nothing(texture, needs.colors, needs.alpha))
      note(": one colour that changes nothing, left out");
    else plan.use = TexturePlan::Use::one_color;
    return plan;
  }
  plan.use = TexturePlan::Use::texels;
  texture.levels = &state.levels;
  if (reasons)
    note((" " + described(state) + ", " + name_of(draw.state.texture_env) + ", " +
          name_of(state.sampler.mag) + " and " + name_of(state.sampler.min) +
          (state.levels.needs_footprint() ? ", level of detail from derivatives" : ""))
             .c_str());
  return plan;
}

}  // namespace tessera::detail
