#include "engine/program/import/assimp_material.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <string_view>

#include <assimp/GltfMaterial.h>

namespace tessera::program {
namespace {

constexpr float kMaxShininess = 16384;
constexpr float kDielectricReflectance = 0.04f;  // glass and plastics, at normal incidence

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
Color scaled(const Color& c, float by) { return {c.r * by, c.g * by, c.b * by, 1}; }

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

float roughness_attenuation(float roughness) { return 1 / (1 + 4 * roughness * roughness); }

float blinn_exponent(float roughness) {
  const float alpha = roughness * roughness;
  return alpha > 0 ? std::clamp(2 / (alpha * alpha) - 2, 1.0f, 1024.0f) : 1024.0f;
}

Material metallic_roughness_material(const aiMaterial& from, const Color& base) {
  const auto factor = [](std::optional<float> x) { return std::clamp(x.value_or(1), 0.0f, 1.0f); };
  const float metal = factor(number(from, AI_MATKEY_METALLIC_FACTOR));
  const float rough = factor(number(from, AI_MATKEY_ROUGHNESS_FACTOR));
  const auto specular_reflectance = [&](float b) {
    return (kDielectricReflectance * (1 - metal) + b * metal) * roughness_attenuation(rough);
  };
  return {.ambient = base,
          .diffuse = base,
          .specular = {specular_reflectance(base.r), specular_reflectance(base.g),
                       specular_reflectance(base.b), 1},
          .emission = emission(from),
          .shininess = blinn_exponent(rough)};
}

Material specular_glossiness_material(const aiMaterial& from, float glossiness) {
  const float rough = 1 - std::clamp(glossiness, 0.0f, 1.0f);
  const Color diffuse = color(from, AI_MATKEY_COLOR_DIFFUSE).value_or(Color{1, 1, 1, 1});
  return {.ambient = diffuse,
          .diffuse = diffuse,
          .specular = scaled(color(from, AI_MATKEY_COLOR_SPECULAR).value_or(Color{1, 1, 1, 1}),
                             roughness_attenuation(rough)),
          .emission = emission(from),
          .shininess = blinn_exponent(rough)};
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

/// Filters that glTF gives by the numbers of OpenGL; absent: the default.
void set_filters(const aiMaterial& from, aiTextureType type, TextureSampler& sampler) {
  int mag = 0, min = 0;
  from.Get(AI_MATKEY_GLTF_MAPPINGFILTER_MAG(type, 0), mag);
  from.Get(AI_MATKEY_GLTF_MAPPINGFILTER_MIN(type, 0), min);
  constexpr int kNearest = 9728, kLinear = 9729, kFirstMipmap = 9984;
  constexpr TextureFilter kMipmaps[] = {
      TextureFilter::nearest_mipmap_nearest, TextureFilter::linear_mipmap_nearest,
      TextureFilter::nearest_mipmap_linear, TextureFilter::linear_mipmap_linear};
  if (mag == kNearest) sampler.mag = TextureFilter::nearest;
  if (min == kNearest) sampler.min = TextureFilter::nearest;
  if (min == kLinear) sampler.min = TextureFilter::linear;
  if (min >= kFirstMipmap && min < kFirstMipmap + 4) sampler.min = kMipmaps[min - kFirstMipmap];
}

}  // namespace

std::optional<ColorTexture> color_texture_of(const aiMaterial& from) {
  for (const aiTextureType type : {aiTextureType_BASE_COLOR, aiTextureType_DIFFUSE}) {
    if (from.GetTextureCount(type) == 0) continue;
    aiString name;
    aiTextureMapMode modes[3] = {aiTextureMapMode_Wrap, aiTextureMapMode_Wrap, aiTextureMapMode_Wrap};
    ColorTexture texture;
    if (from.GetTexture(type, 0, &name, nullptr, &texture.channel, nullptr, nullptr, modes) != AI_SUCCESS)
      continue;
    texture.name = name.C_Str();
    texture.sampler.wrap_s = wrap_of(modes[0]);
    texture.sampler.wrap_t = wrap_of(modes[1]);
    set_filters(from, type, texture.sampler);
    from.Get(AI_MATKEY_UVTRANSFORM(type, 0), texture.transform);
    return texture;
  }
  return std::nullopt;
}

void set_alpha_and_faces(const aiMaterial& from, ModelPart& part) {
  aiString mode;
  if (from.Get(AI_MATKEY_GLTF_ALPHAMODE, mode) != AI_SUCCESS) {
    if (const float opacity = number(from, AI_MATKEY_OPACITY).value_or(1); opacity < 1) {
      part.material.diffuse.a = std::max(opacity, 0.0f);
      part.alpha = ModelAlpha::blend;
    }
    return;
  }
  const std::string_view name = mode.C_Str();
  if (name == "MASK") part.alpha = ModelAlpha::mask;
  if (name == "BLEND") part.alpha = ModelAlpha::blend;
  part.alpha_cutoff = number(from, AI_MATKEY_GLTF_ALPHACUTOFF).value_or(0.5f);
  int two_sided = 0;
  part.is_double_sided = from.Get(AI_MATKEY_TWOSIDED, two_sided) != AI_SUCCESS || two_sided != 0;
}

}  // namespace tessera::program
