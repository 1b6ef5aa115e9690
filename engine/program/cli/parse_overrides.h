// Parses options that override values of a scene.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "engine/program/scene/scene.h"

namespace tessera::program::cli {

/// Parses finite numbers separated by commas. Returns nothing if the text is malformed or the count of
/// numbers out of range.
std::vector<double> parse_numbers(const std::string& text, std::size_t min_count, std::size_t max_count);

// Each throws Error, naming what was found and expected: for another form, and for the right form with values
// that make no sense.

/// "640x480"
void parse_size(const std::string& text, SceneOverrides& overrides);
/// "EX,EY,EZ,TX,TY,TZ[,FOVY]": eye, target, and vertical angle of view in degrees. Eye and target must
/// differ.
void parse_camera(const std::string& text, SceneOverrides& overrides);
/// "X,Y,Z[,W]": adds a white light at a position, or with W = 0 from a direction, which must have a length.
void parse_light(const std::string& text, SceneOverrides& overrides);
/// "none", "#rrggbb" or "R,G,B", each 0 to 1.
void parse_background(const std::string& text, SceneOverrides& overrides);

}  // namespace tessera::program::cli
