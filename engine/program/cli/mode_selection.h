// The display modes and dithers that `tessera modes SCENE` compares.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "engine/tessera/display_mode.hpp"

namespace tessera::program::cli {

/// Returns false for a mode of character cells.
bool has_pixels(const DisplayMode& mode);

/// All named modes with pixels.
std::vector<DisplayMode> modes_with_pixels();

/// Parses names separated by commas. Parameters of a mode may follow its name:
/// "ega,cga:palette=0,intensity=low,640x480x12".
/// @throws Error for unknown names, with a suggestion, and for modes of character cells
std::vector<DisplayMode> parse_modes(const std::string& text);

/// Parses names of dithers separated by commas; repeated names count once.
/// @throws Error for unknown names, with a suggestion
std::vector<Dither> parse_dithers(const std::string& text);

/// All dithers, in the order of kDithers.
std::vector<Dither> all_dithers();

/// Modes that show the same picture and take the same memory, such as those that differ in timing only.
struct ModeGroup {
  DisplayMode mode;                ///< the first of them
  std::vector<std::string> names;  ///< all of them, each once
};

/// Returns the groups in the order of their first modes.
std::vector<ModeGroup> grouped(std::span<const DisplayMode> modes);

/// The names, separated by ", ".
std::string names_of(const ModeGroup& group);

/// Columns per degree of visual angle, for a picture as large as a 14-inch 4:3 screen allows, seen from 50
/// cm. At least kMinPixelsPerDegree. 640 columns: 19.63.
double own_pixels_per_degree(const DisplayMode& mode);

}  // namespace tessera::program::cli
