#include "engine/imageio/picture.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "engine/imageio/atomic_file.h"
#include "engine/imageio/module_loader.h"

namespace tessera {
namespace {

std::string lower_case_ending(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

std::string header(const char* magic, int width, int height, bool has_maximum = true) {
  return std::string(magic) + "\n" + std::to_string(width) + " " + std::to_string(height) + "\n" + (has_maximum ? "255\n" : "");
}

std::string ppm(const Picture& picture) {
  std::string file = header("P6", picture.width, picture.height);
  file.reserve(file.size() + picture.rgba.size() / 4 * 3);
  for (std::size_t i = 0; i < picture.rgba.size(); i += 4) file.append(reinterpret_cast<const char*>(&picture.rgba[i]), 3);
  return file;
}

std::string pgm(const Picture& picture) {
  std::string file = header("P5", picture.width, picture.height);
  for (std::size_t i = 0; i < picture.rgba.size(); i += 4)
    file += static_cast<char>((30 * picture.rgba[i] + 59 * picture.rgba[i + 1] + 11 * picture.rgba[i + 2] + 50) / 100);
  return file;
}

std::string raw(const Picture& picture) { return {reinterpret_cast<const char*>(picture.rgba.data()), picture.rgba.size()}; }

}  // namespace

Picture::Picture(int width_px, int height_px)
    : width(width_px), height(height_px), rgba(4 * static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px)) {}

ImageTarget Picture::target() { return {.pixels = rgba.data(), .width = width, .height = height, .stride_bytes = 4 * std::ptrdiff_t{width}}; }

void write_picture(const Picture& picture, const std::string& path) {
  const auto encoded = [&]() -> std::string {
    const std::string ending = lower_case_ending(path);
    if (ending.empty()) throw Error("its name has no ending to tell the format by; .png and .ppm are the usual ones");
    if (ending == ".pbm") throw Error("a .pbm holds one plane; write a .ppm or .png, or the planes one by one");
    if (ending == ".ppm") return ppm(picture);
    if (ending == ".pgm") return pgm(picture);
    if (ending == ".raw") return raw(picture);
    return encode_by_module(picture, ending);
  };
  std::string file;
  try {
    file = encoded();
  } catch (const Error& error) {
    throw Error("cannot write \"" + path + "\": " + error.what());
  }
  write_file_atomically(path, file);
}

void write_plane(const PlaneView& plane, const std::string& path) {
  std::string file = header("P4", plane.width, plane.height, false);
  const std::size_t bytes = (static_cast<std::size_t>(plane.width) + 7) / 8;
  const int spare_bits = static_cast<int>(8 * bytes) - plane.width;
  for (int y = 0; y < plane.height; ++y) {
    file.append(reinterpret_cast<const char*>(plane.bits + y * plane.stride_bytes), bytes);
    file.back() = static_cast<char>(static_cast<unsigned char>(file.back()) & (0xffu << spare_bits));  // what lies right of the picture
  }
  write_file_atomically(path, file);
}

}  // namespace tessera
