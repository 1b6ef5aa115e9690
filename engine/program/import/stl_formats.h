// The two forms of STL files.
#pragma once

#include <string>
#include <vector>

#include "engine/program/import/model_file.h"
#include "engine/program/import/stl_facets.h"

namespace tessera::program {

/// Content of an STL file.
struct StlContent {
  StlFacets facets;
  Color object_color{1, 1, 1, 1};     ///< color of facets that have none
  std::vector<std::string> warnings;  ///< without the file's name
};

/// Reads a file of keywords: `solid`, `facet normal X Y Z`, `outer loop`, `vertex X Y Z`, ...
/// - Keywords may have capitals. Line breaks matter only after `solid` and `endsolid`, which names follow.
/// - Lines before `solid` and between solids, and those that begin with #, // or ; are comments.
/// - A facet of more than three vertices becomes a fan.
/// @throws Error, naming the line, for other text
StlContent read_stl_text(ModelFile& file);

/// Reads a header of 80 bytes, the number of facets, and 50 bytes for each of them: normal and corners as
/// floats, and two bytes for a color.
/// - `COLOR=` and four bytes RGBA in the header, as Materialise Magics writes: the object's color. The two
///   bytes are then a color with red lowest, unless bit 15 is set, which means the object's color.
/// - Else, as VisCAM and SolidView write: a color with blue lowest if bit 15 is set.
/// @throws Error, naming the byte, for a file without a whole facet
StlContent read_stl_binary(ModelFile& file);

}  // namespace tessera::program
