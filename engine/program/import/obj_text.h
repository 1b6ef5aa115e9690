// OBJ and MTL files as they are found, turned into what tinyobjloader reads as it was meant.
#pragma once

#include <array>
#include <string>
#include <vector>

namespace tessera::program {

/// Stand for a space inside a name, since tinyobjloader ends some names at the first one, and for a
/// backslash, which it takes away.
inline constexpr char kSpaceInName = '\x1f', kBackslashInName = '\x1e';

/// Takes away a byte order mark, joins continued lines ("\" at the end; lines keep their numbers), puts
/// kSpaceInName into the names of materials and material files, and kBackslashInName into the latter, and
/// empties lines that nobody needs: weights, of which tinyobjloader casts any float to a joint's int; lines
/// and points, for whose zeros it refuses the model; and tags, which it copies into every group, as large as
/// they say they are.
std::string normalized_obj(const std::string& text);

/// The same for an MTL file. A colour of one number becomes a grey; colours given as spectral curves or in
/// XYZ, and an illum that is no int, are left out, with a line in `warnings`.
std::string normalized_mtl(const std::string& text, const std::string& path,
                           std::vector<std::string>& warnings);

/// A name with its spaces.
std::string with_spaces(std::string name);

/// What the name of a material file can mean: backslashes are Windows' separators but before spaces, or all
/// of them escape what follows.
std::array<std::string, 2> possible_paths(std::string name);

}  // namespace tessera::program
