// The module libtessera_imageio: the only code that sees OpenImageIO. OpenImageIO brings 260 libraries and 130 MiB with it,
// so the program loads it when the first file needs it.
#include <cstdio>
#include <exception>
#include <memory>
#include <string>

#include <OpenImageIO/imageio.h>

#include "engine/export.h"
#include "engine/imageio/module_interface.h"

namespace {

// zlib's level 3 makes files 10 to 20 percent larger than its default 6, in a third of the time.
constexpr int kPngCompression = 3;

std::string write(const char* path, const unsigned char* rgba, int width, int height, std::ptrdiff_t stride_bytes) {
  OIIO::attribute("threads", 1);  // the renderer's threads are the process's threads
  const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(path);
  if (!output) {
    const std::string reason = OIIO::geterror();
    return reason.empty() ? "the format of its ending is unknown" : reason;
  }
  constexpr int kChannels = 3;
  OIIO::ImageSpec spec(width, height, kChannels, OIIO::TypeDesc::UINT8);
  spec.attribute("png:compressionLevel", kPngCompression);
  if (!output->open(path, spec)) return output->geterror();
  if (!output->write_image(OIIO::TypeDesc::UINT8, rgba, 4, stride_bytes)) return output->geterror();
  if (!output->close()) return output->geterror();
  return "";
}

}  // namespace

extern "C" TESSERA_API int tessera_imageio_write_1(const char* path, const unsigned char* rgba, int width, int height,
                                                   std::ptrdiff_t stride_bytes, char* message, std::size_t message_size) {
  std::string reason;
  try {
    reason = write(path, rgba, width, height, stride_bytes);
    if (reason.empty()) return 0;
  } catch (const std::exception& error) {
    reason = error.what();
  }
  std::snprintf(message, message_size, "%s", reason.c_str());
  return 1;
}
