#include "perf/accuracy/png_bytes.h"

#include "engine/program/imageio/png.h"

namespace tessera::accuracy {

std::string png_bytes(const program::Picture& picture, PngEffort effort) {
  constexpr int kSmallest = 9;
  return program::encode_png(program::as_png(picture, 3),
                             effort == PngEffort::small ? kSmallest : program::kDefaultCompression);
}

std::string base64(std::string_view bytes) {
  constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const auto byte = [&](std::size_t k) {
      return i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u;
    };
    const unsigned triple = byte(0) << 16 | byte(1) << 8 | byte(2);
    for (const int shift : {18, 12, 6, 0}) text += kDigits[triple >> shift & 63];
    if (i + 2 >= bytes.size()) text.back() = '=';
    if (i + 1 >= bytes.size()) text[text.size() - 2] = '=';
  }
  return text;
}

}  // namespace tessera::accuracy
