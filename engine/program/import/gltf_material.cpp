#include "engine/program/import/gltf_material.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "engine/program/import/physical_material.h"
#include "framebuffer/srgb.h"

namespace tessera::program {
namespace {

using Value = tinygltf::Value;

/// A number of an extension; `fallback` if it is missing or no number.
double number(const Value& object, const char* key, double fallback) {
  if (!object.IsObject() || !object.Has(key) || !object.Get(key).IsNumber()) return fallback;
  const double value = object.Get(key).GetNumberAsDouble();
  return std::isfinite(value) ? value : fallback;
}

template <std::size_t N>
std::array<double, N> numbers(const Value& object, const char* key, std::array<double, N> fallback) {
  if (!object.IsObject() || !object.Has(key) || !object.Get(key).IsArray()) return fallback;
  const Value& list = object.Get(key);
  for (std::size_t i = 0; i < N && i < list.ArrayLen(); ++i)
    if (list.Get(i).IsNumber()) fallback[i] = list.Get(i).GetNumberAsDouble();
  return fallback;
}

const Value* extension(const tinygltf::ExtensionMap& extensions, const char* name) {
  const auto found = extensions.find(name);
  return found == extensions.end() ? nullptr : &found->second;
}

double share(double value) { return std::clamp(std::isfinite(value) ? value : 1.0, 0.0, 1.0); }

template <class List>
Color color(const List& linear, double alpha) {
  return {display_referred(linear[0]), display_referred(linear[1]), display_referred(linear[2]),
          static_cast<float>(alpha)};
}

TextureWrap wrap_of(int wrap) {
  if (wrap == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE) return TextureWrap::clamp_to_edge;
  return wrap == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT ? TextureWrap::mirrored_repeat : TextureWrap::repeat;
}

TextureSampler sampler_of(const tinygltf::Sampler& from) {
  TextureSampler sampler;
  sampler.wrap_s = wrap_of(from.wrapS);
  sampler.wrap_t = wrap_of(from.wrapT);
  if (from.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST) sampler.mag = TextureFilter::nearest;
  switch (from.minFilter) {
    case TINYGLTF_TEXTURE_FILTER_NEAREST: sampler.min = TextureFilter::nearest; break;
    case TINYGLTF_TEXTURE_FILTER_LINEAR: sampler.min = TextureFilter::linear; break;
    case TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_NEAREST:
      sampler.min = TextureFilter::nearest_mipmap_nearest;
      break;
    case TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_NEAREST:
      sampler.min = TextureFilter::linear_mipmap_nearest;
      break;
    case TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_LINEAR:
      sampler.min = TextureFilter::nearest_mipmap_linear;
      break;
    default: break;
  }
  return sampler;
}

/// Rotates by the angle against the clock as seen with t downwards, after scaling; then moves.
void set_transform(const Value& transform, GltfTexture& texture) {
  const auto offset = numbers<2>(transform, "offset", {0, 0}), scale = numbers<2>(transform, "scale", {1, 1});
  const double angle = number(transform, "rotation", 0), c = std::cos(angle), s = std::sin(angle);
  const double x[3] = {c * scale[0], s * scale[1], offset[0]},
               y[3] = {-s * scale[0], c * scale[1], offset[1]};
  std::copy_n(x, 3, texture.x);
  std::copy_n(y, 3, texture.y);
  texture.coordinates = static_cast<int>(number(transform, "texCoord", texture.coordinates));
}

std::optional<GltfTexture> texture_of(const tinygltf::Model& gltf, int index, int coordinates,
                                      const Value* transform, std::size_t image_count) {
  if (index < 0) return std::nullopt;
  if (static_cast<std::size_t>(index) >= gltf.textures.size())
    throw Error("a material refers to texture " + std::to_string(index) + ", there are " +
                std::to_string(gltf.textures.size()));
  const tinygltf::Texture& from = gltf.textures[static_cast<std::size_t>(index)];
  if (from.source < 0) return std::nullopt;  // an image of an extension, such as KTX
  if (static_cast<std::size_t>(from.source) >= image_count)
    throw Error("a texture refers to image " + std::to_string(from.source) + ", there are " +
                std::to_string(image_count));
  GltfTexture texture{.texture = {.image = static_cast<std::size_t>(from.source), .sampler = {}},
                      .coordinates = coordinates};
  if (from.sampler >= 0 && static_cast<std::size_t>(from.sampler) < gltf.samplers.size())
    texture.texture.sampler = sampler_of(gltf.samplers[static_cast<std::size_t>(from.sampler)]);
  if (transform != nullptr) set_transform(*transform, texture);
  return texture;
}

/// Base colour and texture of KHR_materials_pbrSpecularGlossiness.
void set_glossy(const tinygltf::Model& gltf, const Value& glossy, std::size_t image_count, GltfMaterial& to) {
  const auto diffuse = numbers<4>(glossy, "diffuseFactor", {1, 1, 1, 1});
  const auto specular = numbers<3>(glossy, "specularFactor", {1, 1, 1});
  std::ranges::copy(diffuse, to.base);
  to.part.material = glossy_material(color(diffuse, share(diffuse[3])), color(specular, 1),
                                     static_cast<float>(share(number(glossy, "glossinessFactor", 1))));
  if (!glossy.Has("diffuseTexture")) return;
  const Value& info = glossy.Get("diffuseTexture");
  const Value* transform = nullptr;
  if (info.Has("extensions") && info.Get("extensions").Has("KHR_texture_transform"))
    transform = &info.Get("extensions").Get("KHR_texture_transform");
  to.texture = texture_of(gltf, static_cast<int>(number(info, "index", -1)),
                          static_cast<int>(number(info, "texCoord", 0)), transform, image_count);
}

void set_metallic(const tinygltf::Model& gltf, const tinygltf::PbrMetallicRoughness& from,
                  std::size_t image_count, GltfMaterial& to) {
  for (std::size_t i = 0; i < 4 && i < from.baseColorFactor.size(); ++i) to.base[i] = from.baseColorFactor[i];
  to.part.material =
      metallic_material(color(to.base, share(to.base[3])), static_cast<float>(share(from.metallicFactor)),
                        static_cast<float>(share(from.roughnessFactor)));
  to.texture = texture_of(gltf, from.baseColorTexture.index, from.baseColorTexture.texCoord,
                          extension(from.baseColorTexture.extensions, "KHR_texture_transform"), image_count);
}

GltfMaterial material_of(const tinygltf::Model& gltf, const tinygltf::Material& from,
                         std::size_t image_count) {
  GltfMaterial to;
  to.part.material_name = from.name;
  if (const Value* glossy = extension(from.extensions, "KHR_materials_pbrSpecularGlossiness"))
    set_glossy(gltf, *glossy, image_count, to);
  else set_metallic(gltf, from.pbrMetallicRoughness, image_count, to);
  to.part.is_unlit = extension(from.extensions, "KHR_materials_unlit") != nullptr;
  to.part.is_double_sided = from.doubleSided;
  if (from.alphaMode == "MASK") to.part.alpha = ModelAlpha::mask;
  if (from.alphaMode == "BLEND") to.part.alpha = ModelAlpha::blend;
  to.part.alpha_cutoff = static_cast<float>(std::isfinite(from.alphaCutoff) ? from.alphaCutoff : 0.5);
  // Without its texture, an emission would shine where the texture is black.
  if (from.emissiveTexture.index < 0 && from.emissiveFactor.size() == 3)
    to.part.material.emission = color(from.emissiveFactor, 1);
  return to;
}

}  // namespace

float display_referred(double linear) {
  return linear > 0 && std::isfinite(linear) ? static_cast<float>(detail::srgb_from_linear(linear)) : 0.0f;
}

std::vector<GltfMaterial> gltf_materials(const tinygltf::Model& gltf, std::size_t image_count) {
  std::vector<GltfMaterial> materials;
  for (const tinygltf::Material& from : gltf.materials)
    materials.push_back(material_of(gltf, from, image_count));
  materials.push_back(material_of(gltf, tinygltf::Material(), image_count));
  return materials;
}

}  // namespace tessera::program
