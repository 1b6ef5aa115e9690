// Reads bitmaps and images.
#include <filesystem>

#include "engine/program/imageio/picture.h"
#include "engine/program/scene/read_scene.h"
#include "engine/program/scene/text_file.h"

namespace tessera::program {
namespace {

using json::Object;
using json::Value;

std::array<double, 2> read_two(const Value& value) {
  if (!value.json().is_array() || value.size() != 2) value.fail("[x, y]");
  return value.numbers<2>();
}

// A number is the depth of the pixels; anything else is a depth test, and the depth is 0.
double read_raster_depth(const Object& object) {
  const auto depth = object.find("depth");
  if (!depth) return 0;
  if (depth->json().is_number()) return depth->number(0, 1);
  if (!depth->json().is_object() && depth->json() != json::Json(false))
    depth->fail("a number from 0 to 1, false or an object");
  return 0;
}

FragmentState read_state(const Object& object, const Scene& scene) {
  DrawState s;
  read_fragment_state(object, scene, s);
  return fragment_state(s);
}

std::shared_ptr<const Picture> read_image_file(const Value& file, const std::string& base_folder,
                                               FileCache& cache) {
  const std::filesystem::path path = std::filesystem::path(base_folder) / file.text();
  auto picture = cache.pictures.find(path.string());
  if (picture == cache.pictures.end()) {
    const auto read = [&] {
      refuse_device_or_pipe(path.string());
      return std::make_shared<const Picture>(read_picture(path.string()));
    };
    picture = cache.pictures.emplace(path.string(), file.checked(read)).first;
  }
  return picture->second;
}

// Returns -1 for other characters.
int hexadecimal_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

}  // namespace

void read_hexadecimal_row(const Value& value, std::size_t bytes, std::vector<std::uint8_t>& row) {
  const std::string expected = std::to_string(2 * bytes) + " hexadecimal digits";
  if (!value.json().is_string()) value.fail(expected);
  const std::string& digits = value.text();
  if (digits.size() != 2 * bytes) value.fail(expected);
  for (std::size_t i = 0; i < digits.size(); i += 2) {
    const int high = hexadecimal_digit(digits[i]);
    const int low = hexadecimal_digit(digits[i + 1]);
    if (high < 0 || low < 0) value.fail(expected);
    row.push_back(static_cast<std::uint8_t>(16 * high + low));
  }
}

BitmapCommand read_bitmap(const Value& value, const Scene& scene) {
  const Object object(value,
                      {"at", "depth", "width", "height", "rows", "color",  //
                       "color_mask", "plane_mask", "scissor", "alpha_test", "stencil", "blend", "logic_op"});
  BitmapCommand command;
  Bitmap& bitmap = command.bitmap;
  const auto [x, y] = read_two(object.require("at"));
  bitmap.x = x;
  bitmap.y = y;
  bitmap.width = static_cast<int>(object.require("width").integer(1, kMaxFrameBufferSize));
  bitmap.height = static_cast<int>(object.require("height").integer(1, kMaxFrameBufferSize));
  const Value rows = object.require("rows");
  if (!rows.json().is_array() || rows.size() != static_cast<std::size_t>(bitmap.height))
    rows.fail("an array of " + std::to_string(bitmap.height) + " rows, the bitmap's height");
  for (std::size_t i = 0; i < rows.size(); ++i)
    read_hexadecimal_row(rows.element(i), (static_cast<std::size_t>(bitmap.width) + 7) / 8, command.bits);
  bitmap.depth = read_raster_depth(object);
  if (const auto color = object.find("color")) bitmap.color = color->color();
  command.state = read_state(object, scene);
  return command;
}

ImageCommand read_image(const Value& value, const Scene& scene, const std::string& base_folder,
                        FileCache& cache) {
  const Object object(value, {"at", "depth", "file", "zoom", "color_mask", "plane_mask", "scissor",
                              "alpha_test", "stencil", "blend", "logic_op"});
  ImageCommand command;
  PixelImage& image = command.image;
  const auto [x, y] = read_two(object.require("at"));
  image.x = x;
  image.y = y;
  if (const auto zoom = object.find("zoom")) {
    const auto [zoom_x, zoom_y] = read_two(*zoom);
    image.zoom_x = zoom_x;
    image.zoom_y = zoom_y;
  }
  image.depth = read_raster_depth(object);
  command.state = read_state(object, scene);
  command.picture = read_image_file(object.require("file"), base_folder, cache);
  return command;
}

Bitmap BitmapCommand::view() const {
  Bitmap view = bitmap;
  view.bits = bits.data();
  return view;
}

PixelImage ImageCommand::view() const {
  PixelImage view = image;
  view.pixels = picture->rgba.data();
  view.width = picture->width;
  view.height = picture->height;
  return view;
}

}  // namespace tessera::program
