// Rewrites OBJ and MTL text so that tinyobjloader reads it as intended.
#pragma once

#include <array>
#include <string>
#include <vector>

namespace tessera::program {

/// Placeholder for a space inside a name: tinyobjloader ends some names at the first space.
inline constexpr char kSpaceInName = '\x1f';
/// Placeholder for a backslash inside a name: tinyobjloader removes backslashes.
inline constexpr char kBackslashInName = '\x1e';

/// - Removes a byte order mark.
/// - Joins lines continued with a final backslash; the following lines keep their numbers.
/// - Puts kSpaceInName into names of materials and material files, kBackslashInName into the latter.
/// - Empties lines of keywords that this program does not use: vertex weights (tinyobjloader casts any float
/// to
///   an int), lines and points (it rejects models with index 0 in them), and tags (it copies them into every
///   group, at their claimed size).
std::string normalized_obj(const std::string& text);

/// Rewrites an MTL file.
/// - Byte order mark, continued lines and names of materials: as normalized_obj() does.
/// - A colour of one number becomes a grey.
/// - Colours given as spectral curves or in XYZ, and an illum that is not an integer, are removed. `warnings`
///   gets a line for each.
std::string normalized_mtl(const std::string& text, const std::string& path,
                           std::vector<std::string>& warnings);

/// Returns the name with its spaces restored.
std::string with_spaces(std::string name);

/// Returns the two possible meanings of the name of a material file:
/// - backslashes separate folders, as on Windows, except before spaces;
/// - every backslash escapes the next character.
std::array<std::string, 2> possible_paths(std::string name);

}  // namespace tessera::program
