// Validates OBJ and MTL files line by line before tinyobjloader reads them. It would silently accept errors:
// a word in place of a number becomes 0, and an index may point anywhere.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>

namespace tessera::program {

/// Checks vertices, normals and faces of an OBJ file.
/// @throws Error with file and line for a number that is missing, malformed or not finite, a face with fewer
///   than 3 or too many corners, an index that refers to no vertex or normal of an earlier line, or an
///   impossible index of a texture coordinate
void check_obj(std::string_view text, const std::string& file);

/// Whether an MTL file has these keys for a material. tinyobjloader does not report them, but missing
/// colours have a default other than black, and textures and transparency cause warnings.
struct MtlKeys {
  bool ambient = false;
  bool diffuse = false;
  bool illum = false;
  bool texture = false;
  bool dissolve = false;
};

/// Checks colours, Ns and d of an MTL file; normalized_mtl() checks illum.
/// @return the keys of each material, by its name
/// @throws Error as check_obj()
std::map<std::string, MtlKeys, std::less<>> check_mtl(std::string_view text, const std::string& file);

}  // namespace tessera::program
