// Images and textures of a scene.
#include <cctype>

#include "image_file.h"
#include "scene_parts.h"

namespace tessera::reference {

std::string path_in(const std::string& directory, const std::string& path) {
  return path.starts_with('/') || directory.empty() ? path : directory + "/" + path;
}

Image parse_image_file(const Value& v, const std::string& directory) {
  const std::string path = path_in(directory, text(v));
  try {
    return read_image(path);
  } catch (const std::exception& e) {
    fail(v.pointer, "a PNG file or a binary PPM or PGM file", e.what());
  }
}

/// Texels written in the scene, two hexadecimal digits a component, rows from the top.
Image parse_texels(const Value& rows, int channels) {
  Image image;
  image.channels = channels;
  image.height = static_cast<int>(array_size(rows));
  const std::size_t digits = 2 * static_cast<std::size_t>(channels);
  for (std::size_t y = array_size(rows); y-- > 0;) {
    const std::string row = text(rows[y]);
    image.width = static_cast<int>(row.size() / digits);
    if (row.empty() || row.size() % digits != 0 || row.size() != text(rows[0]).size())
      fail(rows[y].pointer, "whole texels, as many as in the first row");
    for (std::size_t i = 0; i < row.size(); i += 2) {
      std::size_t used = 0;
      const unsigned long level = std::isxdigit(static_cast<unsigned char>(row[i])) != 0
                                      ? std::stoul(row.substr(i, 2), &used, 16)
                                      : 0;
      if (used != 2) fail(rows[y].pointer, "hexadecimal digits");
      image.levels.push_back(static_cast<std::uint8_t>(level));
    }
  }
  if (image.height == 0) fail(rows.pointer, "rows");
  return image;
}

Texture parse_texture(const Value& v, const std::string& name, const std::string& directory) {
  const std::vector<std::pair<const char*, Wrap>> wraps{{"repeat", Wrap::kRepeat},
                                                        {"clamp_to_edge", Wrap::kClampToEdge},
                                                        {"mirrored_repeat", Wrap::kMirroredRepeat}};
  ObjectReader reader(v);
  Texture texture;
  texture.name = name;
  if (const Value rows = reader.find("rows"))
    texture.image = parse_texels(rows, static_cast<int>(integer(reader.require("channels"), 1, 4)));
  else texture.image = parse_image_file(reader.require("file"), directory);
  if (const Value mag = reader.find("mag"))
    texture.mag = choice<MagFilter>(mag, {{"nearest", MagFilter::kNearest}, {"linear", MagFilter::kLinear}});
  if (const Value min = reader.find("min"))
    texture.min = choice<MinFilter>(min, {{"nearest", MinFilter::kNearest},
                                          {"linear", MinFilter::kLinear},
                                          {"nearest_mipmap_nearest", MinFilter::kNearestMipmapNearest},
                                          {"linear_mipmap_nearest", MinFilter::kLinearMipmapNearest},
                                          {"nearest_mipmap_linear", MinFilter::kNearestMipmapLinear},
                                          {"linear_mipmap_linear", MinFilter::kLinearMipmapLinear}});
  if (const Value wrap = reader.find("wrap_s")) texture.wrap_s = choice(wrap, wraps);
  if (const Value wrap = reader.find("wrap_t")) texture.wrap_t = choice(wrap, wraps);
  reader.finish();
  return texture;
}

}  // namespace tessera::reference
