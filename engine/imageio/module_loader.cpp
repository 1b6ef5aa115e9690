#include "engine/imageio/module_loader.h"

#include <algorithm>
#include <filesystem>

#include <dlfcn.h>

#include "engine/imageio/module_interface.h"

namespace tessera {
namespace {

tessera_imageio_encode_function* load_module(const std::string& ending) {
  std::error_code no_program;
  const std::filesystem::path folder = std::filesystem::read_symlink("/proc/self/exe", no_program).parent_path();
  std::string reason;
  for (const std::filesystem::path& candidate :
       {folder / TESSERA_IMAGEIO_FILE_NAME, folder / "../lib" / TESSERA_IMAGEIO_FILE_NAME, std::filesystem::path(TESSERA_IMAGEIO_FILE_NAME)}) {
    std::error_code error;
    if (candidate.has_parent_path() && !std::filesystem::exists(candidate, error)) continue;
    // Local, and bound now: what it brings stays out of the way, and what it lacks is told here.
    if (void* module = ::dlopen(candidate.c_str(), RTLD_NOW | RTLD_LOCAL))
      if (void* function = ::dlsym(module, TESSERA_IMAGEIO_ENCODE_NAME)) return reinterpret_cast<tessera_imageio_encode_function*>(function);
    reason = ::dlerror();
  }
  throw Error(ending + " needs the module " TESSERA_IMAGEIO_FILE_NAME ", which could not be loaded (" + reason + "); .ppm works without it");
}

}  // namespace

std::string encode_by_module(const Picture& picture, const std::string& ending) {
  static tessera_imageio_encode_function* const encode = load_module(ending);  // a failure leaves it unset: the next call tries anew
  std::string file;
  const auto take = [](void* user, const unsigned char* bytes, std::size_t count) {
    static_cast<std::string*>(user)->assign(reinterpret_cast<const char*>(bytes), count);
  };
  char message[512] = "";
  if (encode(ending.c_str(), picture.rgba.data(), picture.width, picture.height, 4 * std::ptrdiff_t{picture.width}, take, &file, message,
             sizeof message) == 0)
    return file;
  std::string reason = message;
  std::replace(reason.begin(), reason.end(), '\n', ' ');
  throw Error(reason);
}

}  // namespace tessera
