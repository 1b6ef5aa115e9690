// Destinations of pictures: files, standard output, the terminal.
#pragma once

#include <optional>
#include <string>

#include "engine/program/imageio/picture.h"

namespace tessera::program::cli {

struct OutputRequest {
  /// A file, with {frame} in its name for numbered pictures; "-": standard output, as PPM; "term": the
  /// terminal.
  std::string path;
  int compression = kDefaultCompression;  ///< PNG level, 0 .. 9
  std::optional<int> delay_ms{};          ///< time of each frame of an animated PNG
};

/// Returns whether `path` is the standard output or the terminal.
bool is_stream(const std::string& path);

/// Returns whether a file name has a {frame}.
bool names_frames(const std::string& path);

/// Replaces {frame} in a file name by the frame's number.
/// - Zeros pad it to 4 digits, or to those of the last frame's number if it has more.
std::string frame_path(const std::string& path, int frame, int frames);

/// @throws Error
void write_output(const Picture& picture, const std::string& path, int compression);

/// Returns the picture as lines of half blocks in 24-bit colour, at most `columns` wide; without colour, as
/// characters of increasing density.
std::string terminal_text(const Picture& picture, int columns, bool colored);

}  // namespace tessera::program::cli
