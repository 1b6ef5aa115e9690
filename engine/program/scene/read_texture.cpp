// Reads textures from image files or from the scene itself.
#include <algorithm>
#include <filesystem>

#include "engine/program/imageio/picture.h"
#include "engine/program/scene/read_scene.h"
#include "engine/program/scene/state_names.h"
#include "engine/program/scene/text_file.h"

namespace tessera::program {
namespace {

using json::Object;
using json::Value;

TextureSampler read_sampler(const Object& object) {
  TextureSampler sampler;
  if (const auto mag = object.find("mag"))
    sampler.mag =
        mag->choice<TextureFilter>({{"nearest", TextureFilter::nearest}, {"linear", TextureFilter::linear}});
  if (const auto min = object.find("min")) sampler.min = min->choice(kTextureFilters);
  if (const auto wrap = object.find("wrap_s")) sampler.wrap_s = wrap->choice(kTextureWraps);
  if (const auto wrap = object.find("wrap_t")) sampler.wrap_t = wrap->choice(kTextureWraps);
  return sampler;
}

// Extracts the channels of the file: pictures always store four.
Texture texture_of(const Picture& picture, const TextureSampler& sampler) {
  const auto channels = static_cast<std::size_t>(picture.channels);
  std::vector<std::uint8_t> pixels;
  pixels.reserve(picture.rgba.size() / 4 * channels);
  for (std::size_t i = 0; i < picture.rgba.size(); i += 4)
    for (std::size_t c = 0; c < channels; ++c)
      pixels.push_back(picture.rgba[i + (channels == 2 && c == 1 ? 3 : c)]);
  return Texture({.pixels = pixels.data(),
                  .width = picture.width,
                  .height = picture.height,
                  .channels = picture.channels},
                 sampler);
}

// Reads rows from the top; the first one determines the width.
Texture read_texels(const Object& object, const TextureSampler& sampler) {
  const auto channels = static_cast<std::size_t>(object.require("channels").integer(1, 4));
  const Value rows = object.require("rows");
  if (!rows.json().is_array() || rows.size() == 0) rows.fail("a list of rows, from the top");
  const Value first = rows.element(0);
  const std::size_t width = first.text().size() / (2 * channels);
  if (width == 0) first.fail("at least " + std::to_string(2 * channels) + " hexadecimal digits, a texel");
  std::vector<std::uint8_t> pixels;
  for (std::size_t i = 0; i < rows.size(); ++i)
    read_hexadecimal_row(rows.element(i), width * channels, pixels);
  // Larger sizes are reduced to kMaxTextureSize + 1, which the texture refuses with its limit.
  const auto side = [](std::size_t texels) {
    return static_cast<int>(std::min<std::size_t>(texels, kMaxTextureSize + 1));
  };
  return rows.checked([&] {
    return Texture({.pixels = pixels.data(),
                    .width = side(width),
                    .height = side(rows.size()),
                    .channels = static_cast<int>(channels)},
                   sampler);
  });
}

std::shared_ptr<const Texture> read_texture(const Value& value, const std::string& base_folder,
                                            FileCache& cache) {
  const bool in_scene = value.json().is_object() && value.json().contains("rows");
  const Object object = in_scene ? Object(value, {"channels", "rows", "mag", "min", "wrap_s", "wrap_t"})
                                 : Object(value, {"file", "mag", "min", "wrap_s", "wrap_t"});
  const TextureSampler sampler = read_sampler(object);
  std::string path;
  if (!in_scene) path = (std::filesystem::path(base_folder) / object.require("file").text()).string();
  std::string key = in_scene ? value.json().dump() : path;
  for (const int part : {static_cast<int>(sampler.mag), static_cast<int>(sampler.min),
                         static_cast<int>(sampler.wrap_s), static_cast<int>(sampler.wrap_t)})
    key += '\n' + std::to_string(part);
  auto texture = cache.textures.find(key);
  if (texture == cache.textures.end()) {
    const auto read_file = [&] {
      refuse_device_or_pipe(path);
      return texture_of(read_picture(path), sampler);
    };
    texture =
        cache.textures
            .emplace(key,
                     std::make_shared<const Texture>(in_scene ? read_texels(object, sampler)
                                                              : object.require("file").checked(read_file)))
            .first;
  }
  return texture->second;
}

}  // namespace

std::vector<std::string> read_textures(const Value& value, const std::string& base_folder, FileCache& cache,
                                       Scene& scene) {
  std::vector<std::string> names;
  value.for_each_member([&](const std::string& name, const Value& member) {
    scene.textures.push_back(read_texture(member, base_folder, cache));
    names.push_back(name);
  });
  return names;
}

}  // namespace tessera::program
