#include "engine/program/import/model_images.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <optional>
#include <string_view>
#include <utility>

#include "engine/program/imageio/picture.h"
#include "engine/program/scene/file_extension.h"
#include "engine/program/scene/text_file.h"

namespace tessera::program {
namespace {

namespace fs = std::filesystem;

std::string lower_case(std::string text) {
  std::ranges::transform(text, text.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

/// The file of a folder whose name differs at most in the case of letters.
std::optional<fs::path> find_ignoring_case(const fs::path& folder, const std::string& name) {
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error))
    if (lower_case(entry.path().filename().string()) == lower_case(name)) return entry.path();
  return std::nullopt;
}

/// assimp's name for the picture of formats that do not name it: that of the model.
constexpr std::string_view kUnnamedPicture = "$texture_dummy";

/// The path of an image file; the plain one if there is no such file.
fs::path image_path(const std::string& model_path, const std::string& name) {
  const fs::path folder = fs::path(model_path).parent_path();
  std::string slashes = name;
  std::ranges::replace(slashes, '\\', '/');
  fs::path file = fs::path(slashes).filename();
  if (file.stem() == kUnnamedPicture)
    file = fs::path(model_path).filename().replace_extension(file.extension());
  // Some exporters begin relative paths with a slash.
  const fs::path candidates[] = {folder / name, folder / slashes, folder / fs::path(slashes).relative_path(),
                                 folder / file};
  std::error_code error;  // such as a name that is too long
  for (const fs::path& path : candidates)
    if (fs::is_regular_file(path, error)) return path;
  for (const fs::path& path : {candidates[2], candidates[3]})
    if (const auto found = find_ignoring_case(path.has_parent_path() ? path.parent_path() : fs::path("."),
                                              path.filename().string());
        found && fs::is_regular_file(*found, error))
      return *found;
  return candidates[0];
}

Picture read_image(const std::string& model_path, const std::string& name) {
  const std::string path = image_path(model_path, name).string();
  refuse_device_or_pipe(path);
  return read_picture(path);
}

std::uint8_t luminance(const std::uint8_t* rgb) {
  return static_cast<std::uint8_t>((299 * rgb[0] + 587 * rgb[1] + 114 * rgb[2] + 500) / 1000);
}

bool has_alpha_channel(const Picture& picture) { return picture.channels == 2 || picture.channels == 4; }

/// Multiplies alpha by another picture, stretched to the size of the first one (nearest pixel): by its
/// alpha if it has one, else by its luminance.
void multiply_alpha(const Picture& alpha, Picture& picture) {
  const bool has_alpha = has_alpha_channel(alpha);
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) {
      const int from_x = static_cast<int>(std::int64_t{x} * alpha.width / picture.width);
      const int from_y = static_cast<int>(std::int64_t{y} * alpha.height / picture.height);
      const std::uint8_t* from =
          &alpha.rgba[4 * (static_cast<std::size_t>(from_y) * static_cast<std::size_t>(alpha.width) +
                           static_cast<std::size_t>(from_x))];
      std::uint8_t& to =
          picture.rgba[4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
                            static_cast<std::size_t>(x)) +
                       3];
      to = static_cast<std::uint8_t>((to * (has_alpha ? from[3] : luminance(from)) + 127) / 255);
    }
}

/// A missing alpha leaves the colours, with a warning.
std::optional<Picture> read_alpha(const std::string& model_path, const ModelImage& image,
                                  std::vector<std::string>& warnings) try {
  if (image.alpha_name.empty()) return std::nullopt;
  return read_image(model_path, image.alpha_name);
} catch (const Error& error) {
  if (image.name.empty() && image.encoded.empty()) throw;
  warnings.push_back(model_path + ": a texture's alpha is left out: " + error.what());
  return std::nullopt;
}

/// The colours of an image; without a file or bytes, white of the size of `alpha`.
Picture read_colors(const std::string& model_path, const ModelImage& image,
                    const std::optional<Picture>& alpha) {
  if (!image.encoded.empty()) return decode_picture(image.encoded, image.name);
  if (!image.name.empty() || !alpha) return read_image(model_path, image.name);
  Picture white(alpha->width, alpha->height);
  std::ranges::fill(white.rgba, std::uint8_t{255});
  return white;
}

void decode(const std::string& model_path, ModelImage& image, std::vector<std::string>& warnings) {
  const std::optional<Picture> alpha = read_alpha(model_path, image, warnings);
  Picture picture = read_colors(model_path, image, alpha);
  // MTL files may name one file twice, for its colours and for its alpha.
  const bool is_own_alpha = image.alpha_name == image.name && has_alpha_channel(picture);
  if (alpha && !is_own_alpha) multiply_alpha(*alpha, picture);
  image.encoded.clear();
  image.encoded.shrink_to_fit();
  image.width = picture.width;
  image.height = picture.height;
  image.pixels = std::move(picture.rgba);
  for (std::size_t i = 3; i < image.pixels.size(); i += 4)
    image.has_alpha = image.has_alpha || image.pixels[i] < 255;
}

/// Numbers of the elements that stay, without gaps; absent: removed.
std::vector<std::optional<std::size_t>> new_numbers(const std::vector<bool>& stays) {
  std::vector<std::optional<std::size_t>> numbers(stays.size());
  std::size_t next = 0;
  for (std::size_t i = 0; i < stays.size(); ++i)
    if (stays[i]) numbers[i] = next++;
  return numbers;
}

template <class Element>
void keep(const std::vector<bool>& stays, std::vector<Element>& elements) {
  std::vector<Element> kept;
  for (std::size_t i = 0; i < elements.size(); ++i)
    if (stays[i]) kept.push_back(std::move(elements[i]));
  elements = std::move(kept);
}

}  // namespace

void decode_images(const std::string& model_path, Model& model) {
  std::vector<bool> texture_is_used(model.textures.size(), false), image_is_used(model.images.size(), false);
  for (const ModelPart& part : model.parts)
    if (part.texture) texture_is_used[*part.texture] = true;
  for (std::size_t i = 0; i < model.textures.size(); ++i)
    if (texture_is_used[i]) image_is_used[model.textures[i].image] = true;

  for (std::size_t i = 0; i < model.images.size(); ++i) {
    if (!image_is_used[i] || !model.images[i].pixels.empty()) continue;
    try {
      decode(model_path, model.images[i], model.warnings);
    } catch (const Error& error) {
      image_is_used[i] = false;
      model.warnings.push_back(model_path + ": a texture is left out: " + error.what());
    }
  }
  for (std::size_t i = 0; i < model.textures.size(); ++i)
    texture_is_used[i] = texture_is_used[i] && image_is_used[model.textures[i].image];

  const auto images = new_numbers(image_is_used), textures = new_numbers(texture_is_used);
  for (ModelPart& part : model.parts)
    if (part.texture) part.texture = textures[*part.texture];
  keep(texture_is_used, model.textures);
  for (ModelTexture& texture : model.textures) texture.image = *images[texture.image];
  keep(image_is_used, model.images);
}

}  // namespace tessera::program
