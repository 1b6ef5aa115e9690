// OBJ and MTL files as they are found, turned into what tinyobjloader reads as it was meant.
#pragma once

#include <string>
#include <vector>

namespace tessera {

/// Stands for a space inside a name: tinyobjloader ends some names at the first space.
inline constexpr char kSpaceInName = '\x1f';

/// Takes away a byte order mark, joins continued lines ("\" at the end; lines keep their numbers), puts kSpaceInName into the names of materials and material
/// files, and empties lines that nobody needs: weights, of which tinyobjloader casts any float to a joint's int; lines and points, for whose zeros it refuses the
/// model; and tags, which it copies into every group, as large as they say they are.
std::string normalized_obj(const std::string& text);

/// The same for an MTL file. A colour of one number becomes a grey; colours given as spectral curves or in XYZ, and an illum that is no int, are
/// left out, with a line in `warnings`.
std::string normalized_mtl(const std::string& text, const std::string& path, std::vector<std::string>& warnings);

/// A name with its spaces.
std::string with_spaces(std::string name);

}  // namespace tessera
