// Where pictures go: files, standard output, the terminal.
#pragma once

#include <string>

#include "engine/program/imageio/picture.h"

namespace tessera::program::cli {

struct OutputRequest {
  std::string
      path;  ///< a file, perhaps with {frame} in its name; "-": standard output, as PPM; "term": the terminal
  int compression = -1;  ///< of PNG, 0 .. 9; -1: the module's default
};

/// The standard output, or the terminal.
bool is_stream(const std::string& path);

/// A file's name with {frame} replaced by the number, of as many digits as the last frame has, four at least.
std::string frame_path(const std::string& path, int frame, int frames);

/// @throws Error
void write_output(const Picture& picture, const std::string& path, int compression);

/// The picture as lines of half blocks in 24-bit colour, at most `columns` wide; without colour as letters of
/// rising density.
std::string terminal_text(const Picture& picture, int columns, bool colored);

}  // namespace tessera::program::cli
