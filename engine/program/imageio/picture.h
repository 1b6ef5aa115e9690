// Reads and writes pictures and planes as files. PNG, PPM, PGM, PFM, PBM and raw are written here; every
// other format is written by the module libtessera_imageio, which is loaded on first use.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/tessera/tessera.hpp"

namespace tessera::program {

/// RGBA, 8 bits per component, rows from the top without gaps.
struct Picture {
  Picture(int width, int height);

  int width, height;
  int channels = 4;  ///< channels in the file: 1 is luminance, 2 luminance and alpha, 3 RGB, 4 RGBA
  bool keeps_alpha =
      false;  ///< files are written with alpha, not multiplied into the colours, if their format has it
  std::vector<std::uint8_t> rgba;

  /// Target for Renderer::finish() and FrameBuffer::read_color().
  ImageTarget target();
};

/// Divides the colours by alpha: a picture drawn over transparent black becomes one with plain alpha.
void divide_by_alpha(Picture& picture);

/// A palette or grey picture of few bits per pixel.
struct IndexedPicture {
  int width = 0, height = 0;
  int bits = 8;                       ///< per pixel: 1, 2, 4 or 8
  std::vector<std::uint8_t> indices;  ///< one per pixel, rows from the top
  std::vector<std::uint8_t> palette;  ///< r g b per entry; empty: greys from black to white
};

constexpr int kDefaultCompression = -1;

/// Writes a picture in the format of the path's extension: .ppm (24 bits), .pgm (luminance), .pfm (floats, 1
/// is full intensity), .raw (RGBA bytes), .png, and every other format of OpenImageIO.
/// - Only .raw has alpha.
/// - An existing file is either replaced as a whole or stays as it was.
/// @param compression  PNG level, 0 .. 9, or kDefaultCompression; other formats ignore it
/// @throws Error, naming the path, for an unknown format, a missing module, or a file that cannot be written
void write_picture(const Picture& picture, const std::string& path, int compression = kDefaultCompression);

/// Writes a PNG file of RGBA pixels. write_picture() leaves alpha out.
void write_png_with_alpha(const Picture& picture, const std::string& path,
                          int compression = kDefaultCompression);

/// Checks, before expensive work, that write_picture() can succeed: it must know the format, and
/// require_writable() must succeed.
/// @return the result of require_writable()
/// @throws Error as write_picture() does
std::optional<std::filesystem::path> require_writable_picture(const std::string& path);

/// Writes a PNG file of picture.bits per pixel.
void write_indexed_png(const IndexedPicture& picture, const std::string& path,
                       int compression = kDefaultCompression);

/// Returns the bytes of a binary PPM file.
std::string encode_ppm(const Picture& picture);

/// Reads an image of 8 bits per component: .ppm directly, every other format through the module.
/// @throws Error, naming the path
Picture read_picture(const std::string& path);

/// Returns the file name extensions that are written without the module.
std::vector<std::string> builtin_extensions();
/// Returns whether files of this name are written by the module.
bool is_written_by_module(const std::string& path);
/// Returns the file name extensions that the module writes.
/// @throws Error without the module
std::vector<std::string> module_extensions();

/// Decodes the bytes of an image file.
/// @param name  for messages; its extension is the format of bytes that do not tell their own
/// @throws Error, naming the image
Picture decode_picture(const std::string& file, const std::string& name);

/// Writes a plane as a binary PBM; a set bit is PBM's 1.
void write_plane(const PlaneView& plane, const std::string& path);

}  // namespace tessera::program
