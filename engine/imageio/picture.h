// Writing pictures and planes to files. PPM, PGM, PBM and raw are written right here; every other format by the module
// libtessera_imageio, which is loaded when first needed.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/tessera/tessera.hpp"

namespace tessera {

/// RGBA, 8 bits each, rows from the top without gaps.
struct Picture {
  Picture(int width, int height);

  int width, height;
  std::vector<std::uint8_t> rgba;

  /// For Renderer::finish and FrameBuffer::read_color.
  ImageTarget target();
};

/// Writes a picture in the format of the path's ending: .ppm (24 bits), .pgm (luminance), .raw (RGBA as it is), .png and
/// whatever else OpenImageIO writes. An existing file is replaced as a whole, or stays as it was.
/// @throws Error, naming the path, for an unknown format, a missing module, or a file that cannot be written.
void write_picture(const Picture& picture, const std::string& path);

/// Writes a plane as a binary PBM; a set bit is PBM's 1.
void write_plane(const PlaneView& plane, const std::string& path);

}  // namespace tessera
