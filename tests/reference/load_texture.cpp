// Images and textures of a scene.
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

Texture parse_texture(const Value& v, const std::string& name, const std::string& directory) {
  const std::vector<std::pair<const char*, Wrap>> wraps{
      {"repeat", Wrap::kRepeat}, {"clamp_to_edge", Wrap::kClampToEdge}, {"mirrored_repeat", Wrap::kMirroredRepeat}};
  ObjectReader reader(v);
  Texture texture;
  texture.name = name;
  texture.image = parse_image_file(reader.require("file"), directory);
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
