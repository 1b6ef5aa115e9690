// The table of `tessera modes SCENE`: what each display mode and dither costs, and how visibly it differs.
#pragma once

#include <span>
#include <string>

#include "engine/program/cli/mode_selection.h"

namespace tessera::program::cli {

/// A picture of the comparison.
struct ModeRow {
  ModeGroup group;
  Dither dither = Dither::none;
  bool reduced = false;          ///< drawn at 24 bits and then reduced
  std::size_t mode_bytes = 0;    ///< memory_bytes(mode)
  std::size_t buffer_bytes = 0;  ///< FrameBuffer::memory_bytes() of all frame buffers
  double frame_ms = 0;           ///< median
  double flip_monitor = 0;       ///< mean FLIP against 24 bits at kDefaultPixelsPerDegree
  double flip_own = 0;           ///< the same at own_pixels_per_degree()
  std::string picture;           ///< file name
  std::string reference;         ///< file name of the picture at 24 bits
};

/// Aligned columns, and a line that explains the two columns of FLIP.
std::string table_text(std::span<const ModeRow> rows);
/// RFC 4180, with a header.
std::string table_csv(std::span<const ModeRow> rows);
/// @param scene  file name; empty: the built-in scene
std::string table_json(std::span<const ModeRow> rows, const std::string& scene);

}  // namespace tessera::program::cli
