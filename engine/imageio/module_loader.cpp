#include "engine/imageio/module_loader.h"

#include <algorithm>
#include <filesystem>

#include <dlfcn.h>

namespace tessera {
namespace {

tessera_imageio_write_function* load_write_function(const std::string& path) {
  std::error_code no_program;
  const std::filesystem::path folder = std::filesystem::read_symlink("/proc/self/exe", no_program).parent_path();
  std::string reason;
  for (const std::filesystem::path& candidate :
       {folder / TESSERA_IMAGEIO_FILE_NAME, folder / "../lib" / TESSERA_IMAGEIO_FILE_NAME, std::filesystem::path(TESSERA_IMAGEIO_FILE_NAME)}) {
    std::error_code error;
    if (candidate.has_parent_path() && !std::filesystem::exists(candidate, error)) continue;
    // Local, and bound now: what it brings stays out of the way, and what it lacks is told here.
    if (void* module = ::dlopen(candidate.c_str(), RTLD_NOW | RTLD_LOCAL))
      if (void* function = ::dlsym(module, TESSERA_IMAGEIO_WRITE_NAME)) return reinterpret_cast<tessera_imageio_write_function*>(function);
    reason = ::dlerror();
  }
  throw Error("cannot write \"" + path + "\": this format needs the module " TESSERA_IMAGEIO_FILE_NAME ", which could not be loaded (" + reason +
              "); .ppm works without it");
}

}  // namespace

void ImageModule::write(const Picture& picture, const std::string& path, const std::string& shown_path) const {
  char message[512] = "";
  if (write_(path.c_str(), picture.rgba.data(), picture.width, picture.height, 4 * std::ptrdiff_t{picture.width}, message, sizeof message) == 0) return;
  std::string reason = message;  // one line, and not about the temporary name
  std::replace(reason.begin(), reason.end(), '\n', ' ');
  while (!reason.empty() && reason.back() == ' ') reason.pop_back();
  for (std::size_t at = reason.find(path); at != std::string::npos; at = reason.find(path, at + shown_path.size())) reason.replace(at, path.size(), shown_path);
  throw Error("cannot write \"" + shown_path + "\": " + (reason.empty() ? "OpenImageIO gives no reason" : reason));
}

const ImageModule& image_module(const std::string& path) {
  static const ImageModule module(load_write_function(path));  // a failure leaves it unloaded: the next call tries anew
  return module;
}

}  // namespace tessera
