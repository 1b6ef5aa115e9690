// What tinyobjloader lets through in silence (a word instead of a number becomes 0, an index may point nowhere) is checked
// first, line by line.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>

namespace tessera {

/// @throws Error with file and line for a number of a vertex or normal that is missing, no number or not finite, and for a
/// face with fewer than three corners or an index that points to no vertex or normal before it.
void check_obj(std::string_view text, const std::string& file);

/// Which colours an MTL file gives for a material: one that is not given is not black.
struct MtlColors {
  bool ambient = false, diffuse = false;
};

/// The same for the colours and numbers of an MTL file that are used. Materials by their names.
std::map<std::string, MtlColors, std::less<>> check_mtl(std::string_view text, const std::string& file);

}  // namespace tessera
