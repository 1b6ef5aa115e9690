// The module libtessera_imageio: the only code that sees OpenImageIO. OpenImageIO brings 260 libraries and 130 MiB with it,
// so the program loads it when the first file needs it.
#include <cstdio>
#include <exception>
#include <memory>
#include <string>
#include <vector>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include "engine/tessera/export.h"
#include "engine/imageio/module_interface.h"

namespace {

// zlib's level 3 makes files 10 to 20 percent larger than its default 6, in a third of the time.
constexpr int kPngCompression = 3;

/// Returns what went wrong, or nothing.
std::string encode(const std::string& ending, const unsigned char* rgba, int width, int height, std::ptrdiff_t stride_bytes,
                   std::vector<unsigned char>& bytes) {
  OIIO::attribute("threads", 1);  // the renderer's threads are the process's threads
  const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create("picture" + ending);
  if (!output) {
    OIIO::geterror();  // names a file that does not exist
    return "OpenImageIO knows no format " + ending;
  }
  OIIO::Filesystem::IOVecOutput memory(bytes);
  if (!output->supports("ioproxy") || !output->set_ioproxy(&memory)) return "OpenImageIO cannot encode " + ending + " in memory";
  constexpr int kChannels = 3;
  OIIO::ImageSpec spec(width, height, kChannels, OIIO::TypeDesc::UINT8);
  spec.attribute("png:compressionLevel", kPngCompression);
  const bool is_encoded = output->open("picture" + ending, spec) && output->write_image(OIIO::TypeDesc::UINT8, rgba, 4, stride_bytes) && output->close();
  return is_encoded ? "" : "OpenImageIO: " + output->geterror();
}

}  // namespace

extern "C" TESSERA_API int tessera_imageio_encode_1(const char* ending, const unsigned char* rgba, int width, int height,
                                                    std::ptrdiff_t stride_bytes, tessera_imageio_take_function* take, void* user,
                                                    char* message, std::size_t message_size) {
  std::string reason;
  try {
    std::vector<unsigned char> bytes;
    reason = encode(ending, rgba, width, height, stride_bytes, bytes);
    if (reason.empty()) {
      take(user, bytes.data(), bytes.size());
      return 0;
    }
  } catch (const std::exception& error) {
    reason = error.what();
  }
  std::snprintf(message, message_size, "%s", reason.c_str());
  return 1;
}
