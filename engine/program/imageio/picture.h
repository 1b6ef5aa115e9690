// Writing pictures and planes to files. PPM, PGM, PBM and raw are written right here; every other format by
// the module libtessera_imageio, which is loaded when first needed.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/tessera/tessera.hpp"

namespace tessera::program {

/// RGBA, 8 bits each, rows from the top without gaps.
struct Picture {
  Picture(int width, int height);

  int width, height;
  int channels = 4;  ///< that its file has: 1 is luminance, 2 luminance and alpha, 3 red green blue
  std::vector<std::uint8_t> rgba;

  /// For Renderer::finish and FrameBuffer::read_color.
  ImageTarget target();
};

/// A picture of palette entries or greys: as few bits a pixel as it has.
struct IndexedPicture {
  int width = 0, height = 0, bits = 8;  ///< 1, 2, 4 or 8
  std::vector<std::uint8_t> indices;    ///< one a pixel, rows from the top
  std::vector<std::uint8_t> palette;    ///< r g b of each entry; empty: greys from black to white
};

constexpr int kDefaultCompression = -1;

/// Writes a picture in the format of the path's ending: .ppm (24 bits), .pgm (luminance), .pfm (floats, 1 is
/// full), .raw (RGBA as it is), .png and whatever else OpenImageIO writes. An existing file is replaced as a
/// whole, or stays as it was.
/// @param compression  of PNG, 0 .. 9
/// @throws Error, naming the path, for an unknown format, a missing module, or a file that cannot be written.
void write_picture(const Picture& picture, const std::string& path, int compression = kDefaultCompression);

/// For who needs long to make the picture: require_writable() of its file, in a format that write_picture()
/// knows.
std::optional<std::filesystem::path> require_writable_picture(const std::string& path);

/// Writes a PNG of that many bits a pixel.
void write_indexed_png(const IndexedPicture& picture, const std::string& path,
                       int compression = kDefaultCompression);

/// Is it a PNG that says, before its pixels, that these functions wrote it?
bool is_tessera_png(const std::string& path);

/// A file's bytes as binary PPM.
std::string encode_ppm(const Picture& picture);

/// Reads an image of 8 bits a component: .ppm by itself, every other format through the module.
/// @throws Error, naming the path.
Picture read_picture(const std::string& path);

/// The endings that are written without the module, and with it.
std::vector<std::string> builtin_extensions();
std::vector<std::string> module_extensions();

/// Writes a plane as a binary PBM; a set bit is PBM's 1.
void write_plane(const PlaneView& plane, const std::string& path);

}  // namespace tessera::program
