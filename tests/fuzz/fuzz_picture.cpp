// Image files whose bytes this project reads and writes itself: PPM, and PNG of few colours.
#include <cstring>
#include <vector>

#include <png.h>

#include "engine/program/imageio/picture.h"
#include "engine/program/imageio/png.h"
#include "tests/fuzz/files.h"
#include "tests/fuzz/fuzz_input.h"
#include "tests/fuzz/target.h"

namespace tessera::fuzz {
using namespace program;
namespace {

void read_ppm(std::string file) {
  files = {{"picture.ppm", std::move(file)}};
  const Picture picture = read_picture("picture.ppm");
  require(picture.channels == 3 && picture.rgba.size() == 4 * static_cast<std::size_t>(picture.width) *
                                                              static_cast<std::size_t>(picture.height),
          "the picture's size differs from its header");
  files["picture.ppm"] = encode_ppm(picture);
  require(read_picture("picture.ppm").rgba == picture.rgba,
          "a picture changes when it is written and read again");
}

void write_png(FuzzInput& from) {
  const int bits = 1 << from.below(4);
  const int width = 1 + from.below(40);
  const int height = 1 + from.below(40);
  const int entries = from.integer(0, 1 << bits);
  const int compression = from.below(10);
  IndexedPicture picture{.width = width, .height = height, .bits = bits};
  for (int i = 0; i < width * height; ++i)
    picture.indices.push_back(
        static_cast<unsigned char>(from.byte() % (entries > 0 && entries < 256 ? entries : 1 << bits)));
  if (entries < 0 || entries > 256) return;  // palettes of files have at most 256 entries
  for (int i = 0; i < 3 * entries; ++i) picture.palette.push_back(from.byte());
  std::string file;
  const auto error = error_of([&] { file = encode_png(as_png(picture), compression); });
  require(error.has_value() == (entries > 1 << bits), "a palette is refused if and only if it does not fit");
  if (error) return;

  png_image image = {};
  image.version = PNG_IMAGE_VERSION;
  require(png_image_begin_read_from_memory(&image, file.data(), file.size()) != 0,
          "a PNG that libpng does not read");
  require(static_cast<int>(image.width) == width && static_cast<int>(image.height) == height,
          "a PNG of another size");
  image.format = PNG_FORMAT_RGB;
  std::vector<unsigned char> pixels(PNG_IMAGE_SIZE(image));
  require(png_image_finish_read(&image, nullptr, pixels.data(), 0, nullptr) != 0,
          "a PNG that ends too early");
  for (std::size_t i = 0; i < picture.indices.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c) {
      const int wanted = entries > 0 ? picture.palette[3 * std::size_t{picture.indices[i]} + c]
                                     : picture.indices[i] * 255 / ((1 << bits) - 1);
      require(pixels[3 * i + c] == wanted, "a pixel of the PNG has another colour");
    }
}

}  // namespace
}  // namespace tessera::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace tessera::fuzz;
  if (size > 0 && data[0] == 'P') {
    error_of([&] { read_ppm(std::string(data, data + size)); });
  } else {
    FuzzInput from(data, size);
    write_png(from);
  }
  return 0;
}
