#include "engine/imageio/module_loader.h"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <sstream>

#include <dlfcn.h>

#include "engine/imageio/module_interface.h"

namespace tessera {
namespace {

void* load_module(const std::string& wanted_for) {
  std::error_code no_program;
  const std::filesystem::path folder = std::filesystem::read_symlink("/proc/self/exe", no_program).parent_path();
  std::string reason;
  for (const std::filesystem::path& candidate :
       {folder / TESSERA_IMAGEIO_FILE_NAME, folder / "../lib" / TESSERA_IMAGEIO_FILE_NAME, std::filesystem::path(TESSERA_IMAGEIO_FILE_NAME)}) {
    std::error_code error;
    if (candidate.has_parent_path() && !std::filesystem::exists(candidate, error)) continue;
    // Local, and bound now: what it brings stays out of the way, and what it lacks is told here.
    if (void* module = ::dlopen(candidate.c_str(), RTLD_NOW | RTLD_LOCAL)) return module;
    reason = ::dlerror();
  }
  throw Error(wanted_for + " needs the module " TESSERA_IMAGEIO_FILE_NAME ", which could not be loaded (" + reason + "); .ppm works without it");
}

template <class Function>
Function* function_of_module(const char* name, const std::string& wanted_for) {
  static void* const module = load_module(wanted_for);  // a failure leaves it unset: the next call tries anew
  void* const function = ::dlsym(module, name);
  if (function == nullptr) throw Error("the module " TESSERA_IMAGEIO_FILE_NAME " is of another version: it has no " + std::string(name));
  return reinterpret_cast<Function*>(function);
}

// Runs call(take, user, message, message size) and returns what it took.
template <class Call>
std::string taken(const Call& call) {
  std::string bytes;
  const auto take = [](void* user, const unsigned char* from, std::size_t count) { static_cast<std::string*>(user)->append(reinterpret_cast<const char*>(from), count); };
  char message[512] = "";
  if (call(+take, static_cast<void*>(&bytes), message, sizeof message) == 0) return bytes;
  std::string reason = message;
  std::replace(reason.begin(), reason.end(), '\n', ' ');
  throw Error(reason);
}

const unsigned char* bytes_of(const std::string& text) { return reinterpret_cast<const unsigned char*>(text.data()); }

}  // namespace

std::string encode_by_module(const Picture& picture, const std::string& ending, int compression) {
  auto* const encode = function_of_module<tessera_imageio_encode_function>(TESSERA_IMAGEIO_ENCODE_NAME, ending);
  return taken([&](auto* take, void* user, char* message, std::size_t size) {
    return encode(ending.c_str(), picture.rgba.data(), picture.width, picture.height, 4 * std::ptrdiff_t{picture.width}, compression, take, user, message, size);
  });
}

std::string encode_indexed_by_module(const IndexedPicture& picture, int compression) {
  auto* const encode = function_of_module<tessera_imageio_encode_indexed_function>(TESSERA_IMAGEIO_ENCODE_INDEXED_NAME, ".png");
  return taken([&](auto* take, void* user, char* message, std::size_t size) {
    return encode(picture.indices.data(), picture.width, picture.height, picture.bits, picture.palette.data(), static_cast<int>(picture.palette.size() / 3), compression, take, user,
                  message, size);
  });
}

Picture decode_by_module(const std::string& file, const std::string& ending) {
  auto* const decode = function_of_module<tessera_imageio_decode_function>(TESSERA_IMAGEIO_DECODE_NAME, ending);
  const std::string decoded = taken([&](auto* take, void* user, char* message, std::size_t size) {
    return decode(ending.c_str(), bytes_of(file), file.size(), kMaxFrameBufferSize, take, user, message, size);
  });
  int size[2];
  std::memcpy(size, decoded.data(), sizeof size);
  Picture picture(size[0], size[1]);
  std::copy(decoded.begin() + sizeof size, decoded.end(), picture.rgba.begin());
  return picture;
}

std::vector<std::string> module_endings() {
  auto* const formats = function_of_module<tessera_imageio_formats_function>(TESSERA_IMAGEIO_FORMATS_NAME, "the list of formats");
  std::istringstream list(taken([&](auto* take, void* user, char* message, std::size_t size) { return formats(take, user, message, size); }));
  std::vector<std::string> endings;
  for (std::string ending; std::getline(list, ending, ',');) endings.push_back(ending);
  std::sort(endings.begin(), endings.end());
  return endings;
}

}  // namespace tessera
