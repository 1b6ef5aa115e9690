// The module libtessera_imageio: the only code that uses OpenImageIO.
// OpenImageIO depends on 260 libraries of 130 MiB, so the program loads the module on first use.
#include <algorithm>
#include <cstdio>
#include <cstring>
#include <exception>
#include <memory>
#include <string>
#include <vector>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include "engine/program/imageio/module_interface.h"
#include "engine/tessera/export.h"

namespace {

using Bytes = std::vector<unsigned char>;

/// Never leaves the module.
struct Failure {
  std::string reason;
};

Bytes encode(const std::string& extension, const unsigned char* rgba, int width, int height,
             std::ptrdiff_t stride_bytes, int channels) {
  const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create("picture" + extension);
  if (!output) {
    OIIO::geterror();  // cleared: its text names a file that does not exist
    throw Failure{"OpenImageIO does not support the format " + extension};
  }
  Bytes bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  if (!output->supports("ioproxy") || !output->set_ioproxy(&memory))
    throw Failure{"OpenImageIO cannot encode " + extension + " in memory"};
  OIIO::ImageSpec spec(width, height, output->supports("alpha") ? channels : 3, OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:UnassociatedAlpha", 1);  // colours are not multiplied by alpha
  const bool is_encoded = output->open("picture" + extension, spec) &&
                          output->write_image(OIIO::TypeDesc::UINT8, rgba, 4, stride_bytes) &&
                          output->close();
  if (!is_encoded) throw Failure{"OpenImageIO: " + output->geterror()};
  return bytes;
}

/// Returns width, height and channels as ints, then RGBA pixels.
Bytes decode(const std::string& extension, const unsigned char* file, std::size_t count, int max_side_px) {
  OIIO::Filesystem::IOMemReader memory(const_cast<unsigned char*>(file), count);  // read only
  OIIO::ImageSpec config;
  config.attribute("oiio:UnassociatedAlpha", 1);  // no premultiplication
  OIIO::Filesystem::IOProxy* const proxy = &memory;
  // open() ignores its own proxy parameter if a configuration is given.
  config.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
  const std::unique_ptr<OIIO::ImageInput> input =
      OIIO::ImageInput::open("picture" + extension, &config, &memory);
  if (!input) {
    const std::string reason = OIIO::geterror();
    // The message would name "picture.EXTENSION", which is no file.
    if (reason.find("not the name of an image format") != std::string::npos)
      throw Failure{"it is no picture of a known format; \"tessera formats\" lists them"};
    throw Failure{"OpenImageIO: " + reason};
  }
  const OIIO::ImageSpec& spec = input->spec();
  if (spec.width < 1 || spec.height < 1 || spec.width > max_side_px || spec.height > max_side_px)
    throw Failure{"the image is " + std::to_string(spec.width) + "x" + std::to_string(spec.height) +
                  ", each side must be 1 to " + std::to_string(max_side_px)};
  const int channels = spec.nchannels;
  if (spec.depth > 1 || channels < 1)  // read_image() returns all layers of a volume
    throw Failure{"the image has " + std::to_string(spec.depth) + " layers of " + std::to_string(channels) +
                  " channels, expected one layer"};
  const std::size_t pixels = static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height);
  const int size[3] = {spec.width, spec.height, channels < 4 ? channels : 4};
  Bytes raw(pixels * static_cast<std::size_t>(channels));
  Bytes bytes(sizeof size + 4 * pixels, 255);
  if (!input->read_image(0, 0, 0, channels, OIIO::TypeDesc::UINT8, raw.data()))
    throw Failure{"OpenImageIO: " + input->geterror()};
  std::memcpy(bytes.data(), size, sizeof size);
  int alpha = -1;  // channel index; -1: none
  if (channels == 2) alpha = 1;
  if (channels >= 4) alpha = 3;
  for (std::size_t i = 0; i < pixels; ++i) {
    const unsigned char* const from = &raw[i * static_cast<std::size_t>(channels)];
    unsigned char* const to = &bytes[sizeof size + 4 * i];
    for (int c = 0; c < 3; ++c) to[c] = from[channels >= 3 ? c : 0];
    if (alpha >= 0) to[3] = from[alpha];
  }
  return bytes;
}

Bytes formats() {
  // "png:png;tiff:tif,tiff;..."
  const std::string all = OIIO::get_string_attribute("extension_list");
  std::string list;
  std::size_t at = 0;
  while (at < all.size()) {
    const std::size_t end = std::min(all.find(';', at), all.size());
    const std::size_t colon = std::min(all.find(':', at), end);
    const std::string extensions = colon < end ? all.substr(colon + 1, end - colon - 1) : "";
    for (std::size_t from = 0; from < extensions.size();) {
      const std::size_t comma = std::min(extensions.find(',', from), extensions.size());
      const std::string extension = "." + extensions.substr(from, comma - from);
      const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create("picture" + extension);
      if (output && output->supports("ioproxy")) list += (list.empty() ? "" : ",") + extension;
      from = comma + 1;
    }
    at = end + 1;
  }
  OIIO::geterror();
  return {list.begin(), list.end()};
}

/// Delivers the bytes of make() to `take`. Catches every exception.
template <class Make>
int deliver_bytes(tessera_imageio_take_function* take, void* user, char* message, std::size_t message_size,
                  const Make& make) {
  std::string reason;
  try {
    OIIO::attribute("threads", 1);  // no threads besides the renderer's
    const Bytes bytes = make();
    take(user, bytes.data(), bytes.size());
    return 0;
  } catch (const Failure& failure) {
    reason = failure.reason;
  } catch (const std::exception& error) {
    reason = error.what();
  }
  std::snprintf(message, message_size, "%s", reason.c_str());
  return 1;
}

}  // namespace

extern "C" TESSERA_API int tessera_imageio_encode_4(const char* extension, const unsigned char* rgba,
                                                    int width, int height, std::ptrdiff_t stride_bytes,
                                                    int channels, tessera_imageio_take_function* take,
                                                    void* user, char* message, std::size_t message_size) {
  return deliver_bytes(take, user, message, message_size,
                       [&] { return encode(extension, rgba, width, height, stride_bytes, channels); });
}

extern "C" TESSERA_API int tessera_imageio_decode_2(const char* extension, const unsigned char* bytes,
                                                    std::size_t count, int max_side_px,
                                                    tessera_imageio_take_function* take, void* user,
                                                    char* message, std::size_t message_size) {
  return deliver_bytes(take, user, message, message_size,
                       [&] { return decode(extension, bytes, count, max_side_px); });
}

extern "C" TESSERA_API int tessera_imageio_formats_1(tessera_imageio_take_function* take, void* user,
                                                     char* message, std::size_t message_size) {
  return deliver_bytes(take, user, message, message_size, [] { return formats(); });
}
