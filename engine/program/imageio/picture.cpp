#include "engine/program/imageio/picture.h"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <iterator>
#include <string_view>

#include "engine/program/imageio/atomic_file.h"
#include "engine/program/imageio/float_picture.h"
#include "engine/program/imageio/module_loader.h"
#include "engine/program/imageio/png.h"
#include "engine/program/scene/file_extension.h"
#include "engine/program/scene/text_file.h"

namespace tessera::program {
namespace {

// Header of the Netpbm formats; PBM has no maximum.
std::string header(const char* magic, int width, int height, bool has_maximum = true) {
  return std::string(magic) + "\n" + std::to_string(width) + " " + std::to_string(height) + "\n" +
         (has_maximum ? "255\n" : "");
}

std::string pgm(const Picture& picture) {
  std::string file = header("P5", picture.width, picture.height);
  for (std::size_t i = 0; i < picture.rgba.size(); i += 4)
    file += static_cast<char>(
        (30 * picture.rgba[i] + 59 * picture.rgba[i + 1] + 11 * picture.rgba[i + 2] + 50) / 100);
  return file;
}

std::string pfm(const Picture& picture) {
  std::vector<float> components;
  components.reserve(picture.rgba.size() / 4 * 3);
  for (std::size_t i = 0; i < picture.rgba.size(); i += 4)
    for (std::size_t c = 0; c < 3; ++c)
      components.push_back(static_cast<float>(picture.rgba[i + c]) / 255.0f);
  return encode_pfm(picture.width, picture.height, 3, components);
}

std::string raw(const Picture& picture) {
  return {reinterpret_cast<const char*>(picture.rgba.data()), picture.rgba.size()};
}

}  // namespace

Picture::Picture(int width_px, int height_px)
    : width(width_px),
      height(height_px),
      rgba(4 * static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px)) {}

ImageTarget Picture::target() {
  return {.pixels = rgba.data(), .width = width, .height = height, .stride_bytes = 4 * std::ptrdiff_t{width}};
}

std::string encode_ppm(const Picture& picture) {
  std::string file = header("P6", picture.width, picture.height);
  file.reserve(file.size() + picture.rgba.size() / 4 * 3);
  for (std::size_t i = 0; i < picture.rgba.size(); i += 4)
    file.append(reinterpret_cast<const char*>(&picture.rgba[i]), 3);
  return file;
}

void divide_by_alpha(Picture& picture) {
  for (std::size_t i = 0; i < picture.rgba.size(); i += 4) {
    const int alpha = picture.rgba[i + 3];
    if (alpha == 0 || alpha == 255) continue;
    for (std::size_t c = 0; c < 3; ++c)
      picture.rgba[i + c] =
          static_cast<std::uint8_t>(std::min((picture.rgba[i + c] * 255 + alpha / 2) / alpha, 255));
  }
}

std::vector<std::string> builtin_extensions() {
  return {".pbm (1 bit)", ".pfm", ".pgm", ".png", ".ppm", ".raw"};
}

bool is_written_by_module(const std::string& path) {
  constexpr std::string_view kBuiltin[] = {".pbm", ".pfm", ".pgm", ".png", ".ppm", ".raw"};
  return std::find(std::begin(kBuiltin), std::end(kBuiltin), lower_case_extension(path)) ==
         std::end(kBuiltin);
}

namespace {

// Returns encode(); adds the path to the messages of its errors.
template <class Encode>
std::string encoded_for(const std::string& path, const Encode& encode) {
  try {
    return encode();
  } catch (const Error& error) {
    throw Error("cannot write \"" + path + "\": " + error.what());
  }
}

// Encodes in the format given by the path's extension.
std::string encode_picture(const Picture& picture, const std::string& path, int compression) {
  return encoded_for(path, [&]() -> std::string {
    const std::string extension = lower_case_extension(path);
    if (extension.empty()) throw Error("the name has no extension, expected one such as .png or .ppm");
    if (extension == ".pbm")
      throw Error("a .pbm file holds 1 bit per pixel; write a .png or .ppm, or the planes with --planes");
    if (extension == ".ppm") return encode_ppm(picture);
    if (extension == ".pgm") return pgm(picture);
    if (extension == ".pfm") return pfm(picture);
    if (extension == ".raw") return raw(picture);
    const int channels = picture.keeps_alpha ? 4 : 3;
    if (extension == ".png") return encode_png(as_png(picture, channels), compression);
    return encode_by_module(picture, extension, channels);
  });
}

// Binary PPM: "P6", width, height and 255, separated by whitespace and comments; then the pixels.
Picture decode_ppm(const std::string& file) {
  std::size_t at = 2;
  const auto number = [&] {
    while (at < file.size() && (std::isspace(static_cast<unsigned char>(file[at])) != 0 || file[at] == '#'))
      at = file[at] == '#' ? std::min(file.find('\n', at), file.size()) : at + 1;
    int value = 0;
    const auto [end, error] = std::from_chars(file.data() + at, file.data() + file.size(), value);
    if (error != std::errc{} || value < 1 || value > kMaxFrameBufferSize)
      throw Error("the header must hold width, height and 255; each side must be 1 to " +
                  std::to_string(kMaxFrameBufferSize));
    at = static_cast<std::size_t>(end - file.data());
    return value;
  };
  if (!file.starts_with("P6")) throw Error("it is not a binary PPM file");
  const int width = number();
  const int height = number();
  if (number() != 255) throw Error("the maximum is not 255: only 8 bits per component are supported");
  ++at;
  const std::size_t needed = 3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  if (file.size() - std::min(at, file.size()) < needed) throw Error("it ends before its last pixel");
  Picture picture(width, height);
  picture.channels = 3;
  for (std::size_t i = 0; i < picture.rgba.size(); i += 4, at += 3) {
    std::copy_n(file.begin() + static_cast<std::ptrdiff_t>(at), 3,
                picture.rgba.begin() + static_cast<std::ptrdiff_t>(i));
    picture.rgba[i + 3] = 255;
  }
  return picture;
}

}  // namespace

namespace {

/// The extension of formats that begin with a signature; empty: others.
std::string extension_by_signature(std::string_view file) {
  if (file.starts_with("\x89PNG")) return ".png";
  if (file.starts_with("\xff\xd8\xff")) return ".jpg";
  if (file.starts_with("GIF8")) return ".gif";
  if (file.starts_with("BM")) return ".bmp";
  if (file.starts_with("RIFF") && file.substr(0, 12).ends_with("WEBP")) return ".webp";
  if (file.starts_with("P6")) return ".ppm";
  return "";
}

}  // namespace

Picture decode_picture(const std::string& file, const std::string& name) {
  try {
    std::string extension = extension_by_signature(file);
    if (extension.empty()) extension = lower_case_extension(name);
    return extension == ".ppm" ? decode_ppm(file) : decode_by_module(file, extension);
  } catch (const Error& error) {
    throw Error("cannot read \"" + name + "\": " + error.what());
  }
}

Picture read_picture(const std::string& path) { return decode_picture(read_text_file(path), path); }

void write_indexed_png(const IndexedPicture& picture, const std::string& path, int compression) {
  write_file_atomically(path, encoded_for(path, [&] { return encode_png(as_png(picture), compression); }));
}

void write_picture(const Picture& picture, const std::string& path, int compression) {
  write_file_atomically(path, encode_picture(picture, path, compression));
}

void write_png_with_alpha(const Picture& picture, const std::string& path, int compression) {
  write_file_atomically(path, encoded_for(path, [&] { return encode_png(as_png(picture, 4), compression); }));
}

std::optional<std::filesystem::path> require_writable_picture(const std::string& path) {
  encode_picture(Picture(1, 1), path, kDefaultCompression);
  return require_writable(path);
}

void write_plane(const PlaneView& plane, const std::string& path) {
  std::string file = header("P4", plane.width, plane.height, false);
  const std::size_t bytes = (static_cast<std::size_t>(plane.width) + 7) / 8;
  const int spare_bits = static_cast<int>(8 * bytes) - plane.width;
  for (int y = 0; y < plane.height; ++y) {
    file.append(reinterpret_cast<const char*>(plane.bits + y * plane.stride_bytes), bytes);
    // Clears the bits to the right of the picture.
    file.back() = static_cast<char>(static_cast<unsigned char>(file.back()) & (0xffu << spare_bits));
  }
  write_file_atomically(path, file);
}

}  // namespace tessera::program
