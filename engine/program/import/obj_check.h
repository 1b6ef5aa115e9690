// What tinyobjloader lets through in silence (a word instead of a number becomes 0, an index may point
// nowhere) is checked first, line by line.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>

namespace tessera::program {

/// @throws Error with file and line for a number of a vertex or normal that is missing, no number or not
/// finite, and for a face with fewer than three corners, an index that points to no vertex or normal before
/// it, or one of a texture coordinate that none can have.
void check_obj(std::string_view text, const std::string& file);

/// What an MTL file says of a material: a colour that is not given is not black, and what is given may not be
/// supported.
struct MtlKeys {
  bool ambient = false, diffuse = false, illum = false, texture = false, dissolve = false;
};

/// The same for the colours, Ns and d of an MTL file (of illum: normalized_mtl()). Materials by their names.
std::map<std::string, MtlKeys, std::less<>> check_mtl(std::string_view text, const std::string& file);

}  // namespace tessera::program
