#include "engine/program/import/assimp_material.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <string_view>

#include <assimp/GltfMaterial.h>

#include "engine/program/import/physical_material.h"

namespace tessera::program {
namespace {

constexpr float kMaxShininess = 16384;

std::optional<Color> color(const aiMaterial& from, const char* key, unsigned type, unsigned index) {
  aiColor4D c;
  if (from.Get(key, type, index, c) != AI_SUCCESS || !std::isfinite(c.r + c.g + c.b)) return {};
  return Color{c.r, c.g, c.b, std::isfinite(c.a) ? c.a : 1};
}

std::optional<float> number(const aiMaterial& from, const char* key, unsigned type, unsigned index) {
  float x = 0;
  if (from.Get(key, type, index, x) != AI_SUCCESS || !std::isfinite(x)) return {};
  return x;
}

// Black, or the value that assimp's readers write for formats without ambient colours.
bool is_placeholder(const Color& c) {
  const bool is_black = c.r <= 0 && c.g <= 0 && c.b <= 0;
  const bool is_default = c.r == 0.05f && c.g == 0.05f && c.b == 0.05f;
  return is_black || is_default;
}

Color emission(const aiMaterial& from) {
  const bool has_picture = from.GetTextureCount(aiTextureType_EMISSIVE) > 0 ||
                           from.GetTextureCount(aiTextureType_EMISSION_COLOR) > 0;
  return has_picture ? Material{}.emission
                     : color(from, AI_MATKEY_COLOR_EMISSIVE).value_or(Material{}.emission);
}

Material phong_material(const aiMaterial& from, int model) {
  Material material;
  material.diffuse = color(from, AI_MATKEY_COLOR_DIFFUSE).value_or(material.diffuse);
  const Color ambient = color(from, AI_MATKEY_COLOR_AMBIENT).value_or(Color{0, 0, 0, 1});
  material.ambient = is_placeholder(ambient) ? material.diffuse : ambient;
  material.emission = emission(from);
  const float shininess = number(from, AI_MATKEY_SHININESS).value_or(0);
  // Exponent 0 would be a highlight on the whole surface.
  const bool has_highlight = shininess > 0 && model != aiShadingMode_Gouraud && model != aiShadingMode_Flat;
  if (has_highlight) {
    material.specular = color(from, AI_MATKEY_COLOR_SPECULAR).value_or(material.specular);
    material.shininess = std::min(shininess, kMaxShininess);
  }
  return material;
}

Material metallic_roughness_material(const aiMaterial& from, const Color& base) {
  const auto factor = [](std::optional<float> x) { return std::clamp(x.value_or(1), 0.0f, 1.0f); };
  Material material = metallic_material(base, factor(number(from, AI_MATKEY_METALLIC_FACTOR)),
                                        factor(number(from, AI_MATKEY_ROUGHNESS_FACTOR)));
  material.emission = emission(from);
  return material;
}

Material specular_glossiness_material(const aiMaterial& from, float glossiness) {
  constexpr Color kWhite{1, 1, 1, 1};
  Material material = glossy_material(color(from, AI_MATKEY_COLOR_DIFFUSE).value_or(kWhite),
                                      color(from, AI_MATKEY_COLOR_SPECULAR).value_or(kWhite),
                                      std::clamp(glossiness, 0.0f, 1.0f));
  material.emission = emission(from);
  return material;
}

Material unlit_material(const Color& c) {
  constexpr Color kNone{0, 0, 0, 1};
  return {.ambient = kNone, .diffuse = {0, 0, 0, c.a}, .specular = kNone, .emission = {c.r, c.g, c.b, 1}};
}

}  // namespace

Material material_of(const aiMaterial& from) {
  const std::optional<Color> base = color(from, AI_MATKEY_BASE_COLOR);
  int model = 0;
  from.Get(AI_MATKEY_SHADING_MODEL, model);
  if (base && model == aiShadingMode_Unlit) return unlit_material(*base);
  if (const auto glossiness = number(from, AI_MATKEY_GLOSSINESS_FACTOR))
    return specular_glossiness_material(from, *glossiness);
  if (base && number(from, AI_MATKEY_METALLIC_FACTOR)) return metallic_roughness_material(from, *base);
  return phong_material(from, model);
}

namespace {

TextureWrap wrap_of(aiTextureMapMode mode) {
  if (mode == aiTextureMapMode_Clamp || mode == aiTextureMapMode_Decal) return TextureWrap::clamp_to_edge;
  return mode == aiTextureMapMode_Mirror ? TextureWrap::mirrored_repeat : TextureWrap::repeat;
}

}  // namespace

std::optional<ColorTexture> color_texture_of(const aiMaterial& from) {
  for (const aiTextureType type : {aiTextureType_BASE_COLOR, aiTextureType_DIFFUSE}) {
    if (from.GetTextureCount(type) == 0) continue;
    aiString name;
    aiTextureMapMode modes[3] = {aiTextureMapMode_Wrap, aiTextureMapMode_Wrap, aiTextureMapMode_Wrap};
    ColorTexture texture;
    if (from.GetTexture(type, 0, &name, nullptr, &texture.channel, nullptr, nullptr, modes) != AI_SUCCESS ||
        name.length == 0)
      continue;
    texture.name = name.C_Str();
    texture.sampler.wrap_s = wrap_of(modes[0]);
    texture.sampler.wrap_t = wrap_of(modes[1]);
    from.Get(AI_MATKEY_UVTRANSFORM(type, 0), texture.transform);
    return texture;
  }
  return std::nullopt;
}

void set_alpha(const aiMaterial& from, ModelPart& part) {
  const float opacity = number(from, AI_MATKEY_OPACITY).value_or(1);
  if (opacity >= 1) return;
  part.material.diffuse.a = std::max(opacity, 0.0f);
  part.alpha = ModelAlpha::blend;
}

}  // namespace tessera::program
