// The module libtessera_imageio: with indexed_png.cpp the only code that sees OpenImageIO and libpng.
// OpenImageIO brings 260 libraries and 130 MiB with it, so the program loads it when the first file needs it.
#include <algorithm>
#include <cstdio>
#include <cstring>
#include <exception>
#include <memory>
#include <string>
#include <vector>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include "engine/program/imageio/indexed_png.h"
#include "engine/program/imageio/module_interface.h"
#include "engine/tessera/export.h"

namespace {

// zlib's level 3 makes files 10 to 20 percent larger than its default 6, in a third of the time.
constexpr int kPngCompression = 3;

using Bytes = std::vector<unsigned char>;

/// Thrown inside the module only.
struct Failure {
  std::string reason;
};

Bytes encode(const std::string& ending, const unsigned char* rgba, int width, int height,
             std::ptrdiff_t stride_bytes, int compression) {
  const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create("picture" + ending);
  if (!output) {
    OIIO::geterror();  // names a file that does not exist
    throw Failure{"OpenImageIO knows no format " + ending};
  }
  Bytes bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  if (!output->supports("ioproxy") || !output->set_ioproxy(&memory))
    throw Failure{"OpenImageIO cannot encode " + ending + " in memory"};
  constexpr int kChannels = 3;
  OIIO::ImageSpec spec(width, height, kChannels, OIIO::TypeDesc::UINT8);
  spec.attribute("Software", TESSERA_IMAGEIO_SOFTWARE);
  spec.attribute("png:compressionLevel", compression >= 0 ? compression : kPngCompression);
  const bool is_encoded = output->open("picture" + ending, spec) &&
                          output->write_image(OIIO::TypeDesc::UINT8, rgba, 4, stride_bytes) &&
                          output->close();
  if (!is_encoded) throw Failure{"OpenImageIO: " + output->geterror()};
  return bytes;
}

/// Width, height and channels, then RGBA.
Bytes decode(const std::string& ending, const unsigned char* file, std::size_t count, int max_side_px) {
  OIIO::Filesystem::IOMemReader memory(const_cast<unsigned char*>(file), count);  // which only reads
  OIIO::ImageSpec asked;
  asked.attribute("oiio:UnassociatedAlpha", 1);  // colours as the file has them
  OIIO::Filesystem::IOProxy* const proxy = &memory;
  asked.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR,
                  &proxy);  // open() forgets its own one where something is asked for
  const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::open("picture" + ending, &asked, &memory);
  if (!input) throw Failure{"OpenImageIO: " + OIIO::geterror()};
  const OIIO::ImageSpec& spec = input->spec();
  if (spec.width < 1 || spec.height < 1 || spec.width > max_side_px || spec.height > max_side_px)
    throw Failure{"the image is " + std::to_string(spec.width) + "x" + std::to_string(spec.height) +
                  ", at most " + std::to_string(max_side_px) + " a side are read"};
  const int channels = spec.nchannels;
  if (spec.depth > 1 || channels < 1)  // read_image() gives every layer of a volume
    throw Failure{"the image has " + std::to_string(spec.depth) + " layers of " + std::to_string(channels) +
                  " channels, expected one layer"};
  const std::size_t pixels = static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height);
  const int size[3] = {spec.width, spec.height, channels < 4 ? channels : 4};
  Bytes raw(pixels * static_cast<std::size_t>(channels)), bytes(sizeof size + 4 * pixels, 255);
  if (!input->read_image(0, 0, 0, channels, OIIO::TypeDesc::UINT8, raw.data()))
    throw Failure{"OpenImageIO: " + input->geterror()};
  std::memcpy(bytes.data(), size, sizeof size);
  const int alpha = channels == 2 ? 1 : channels >= 4 ? 3 : -1;
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
  std::string list, all = OIIO::get_string_attribute("extension_list");
  std::size_t at = 0;
  while (at < all.size()) {
    const std::size_t end = std::min(all.find(';', at), all.size()), colon = std::min(all.find(':', at), end);
    std::string endings = colon < end ? all.substr(colon + 1, end - colon - 1) : "";
    for (std::size_t from = 0; from < endings.size();) {
      const std::size_t comma = std::min(endings.find(',', from), endings.size());
      const std::string ending = "." + endings.substr(from, comma - from);
      const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create("picture" + ending);
      if (output && output->supports("ioproxy")) list += (list.empty() ? "" : ",") + ending;
      from = comma + 1;
    }
    at = end + 1;
  }
  OIIO::geterror();
  return {list.begin(), list.end()};
}

/// Runs make() and hands its bytes over; no exception leaves the module.
template <class Make>
int deliver_bytes(tessera_imageio_take_function* take, void* user, char* message, std::size_t message_size,
                  const Make& make) {
  std::string reason;
  try {
    OIIO::attribute("threads", 1);  // the renderer's threads are the process's threads
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

extern "C" TESSERA_API int tessera_imageio_encode_2(const char* ending, const unsigned char* rgba, int width,
                                                    int height, std::ptrdiff_t stride_bytes, int compression,
                                                    tessera_imageio_take_function* take, void* user,
                                                    char* message, std::size_t message_size) {
  return deliver_bytes(take, user, message, message_size,
                       [&] { return encode(ending, rgba, width, height, stride_bytes, compression); });
}

extern "C" TESSERA_API int tessera_imageio_encode_indexed_1(const unsigned char* indices, int width,
                                                            int height, int bits,
                                                            const unsigned char* palette, int palette_entries,
                                                            int compression,
                                                            tessera_imageio_take_function* take, void* user,
                                                            char* message, std::size_t message_size) {
  return deliver_bytes(take, user, message, message_size, [&] {
    Bytes bytes;
    const std::string reason =
        tessera::program::encode_indexed_png(indices, width, height, bits, palette, palette_entries,
                                             compression >= 0 ? compression : kPngCompression, bytes);
    if (!reason.empty()) throw Failure{reason};
    return bytes;
  });
}

extern "C" TESSERA_API int tessera_imageio_decode_2(const char* ending, const unsigned char* bytes,
                                                    std::size_t count, int max_side_px,
                                                    tessera_imageio_take_function* take, void* user,
                                                    char* message, std::size_t message_size) {
  return deliver_bytes(take, user, message, message_size,
                       [&] { return decode(ending, bytes, count, max_side_px); });
}

extern "C" TESSERA_API int tessera_imageio_formats_1(tessera_imageio_take_function* take, void* user,
                                                     char* message, std::size_t message_size) {
  return deliver_bytes(take, user, message, message_size, [] { return formats(); });
}
