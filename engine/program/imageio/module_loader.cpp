#include "engine/program/imageio/module_loader.h"

#include <algorithm>
#include <cstring>
#include <sstream>

#include "engine/program/imageio/module_interface.h"
#include "engine/program/scene/loaded_module.h"

namespace tessera::program {
namespace {

template <class Function>
Function* imageio_module_function(const char* name, const std::string& wanted_for) {
  // If load_module() throws, the next call tries again.
  static void* const module =
      load_module(TESSERA_IMAGEIO_FILE_NAME, wanted_for, ".png and .ppm pictures are written without it");
  return reinterpret_cast<Function*>(function_of(module, TESSERA_IMAGEIO_FILE_NAME, name));
}

const unsigned char* bytes_of(const std::string& text) {
  return reinterpret_cast<const unsigned char*>(text.data());
}

}  // namespace

std::string encode_by_module(const Picture& picture, const std::string& extension, int channels) {
  auto* const encode =
      imageio_module_function<tessera_imageio_encode_function>(TESSERA_IMAGEIO_ENCODE_NAME, extension);
  return collect_bytes([&](auto* take, void* user, char* message, std::size_t size) {
    return encode(extension.c_str(), picture.rgba.data(), picture.width, picture.height,
                  4 * std::ptrdiff_t{picture.width}, channels, take, user, message, size);
  });
}

Picture decode_by_module(const std::string& file, const std::string& extension) {
  auto* const decode =
      imageio_module_function<tessera_imageio_decode_function>(TESSERA_IMAGEIO_DECODE_NAME, extension);
  const std::string decoded = collect_bytes([&](auto* take, void* user, char* message, std::size_t size) {
    return decode(extension.c_str(), bytes_of(file), file.size(), kMaxFrameBufferSize, take, user, message,
                  size);
  });
  int size[3];
  std::memcpy(size, decoded.data(), sizeof size);
  Picture picture(size[0], size[1]);
  picture.channels = size[2];
  std::copy(decoded.begin() + sizeof size, decoded.end(), picture.rgba.begin());
  return picture;
}

std::vector<std::string> module_extensions() {
  auto* const formats = imageio_module_function<tessera_imageio_formats_function>(
      TESSERA_IMAGEIO_FORMATS_NAME, "the list of formats");
  std::istringstream list(collect_bytes([&](auto* take, void* user, char* message, std::size_t size) {
    return formats(take, user, message, size);
  }));
  std::vector<std::string> extensions;
  for (std::string extension; std::getline(list, extension, ',');) extensions.push_back(extension);
  std::sort(extensions.begin(), extensions.end());
  return extensions;
}

}  // namespace tessera::program
