// The content of an OBJ file as it stands: coordinates in double precision, and elements by their indices.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "engine/program/import/byte_stream.h"
#include "engine/program/scene/mesh_data.h"

namespace tessera::program {

inline constexpr std::int32_t kNoObjIndex = -1;

struct ObjCorner {
  std::uint32_t position = 0;
  std::int32_t texcoord = kNoObjIndex;
  std::int32_t normal = kNoObjIndex;
};

/// A face, a polyline or a set of points.
struct ObjElement {
  Primitive primitive = Primitive::polygon;  ///< polygon, line_strip or points
  std::uint32_t corner_count = 0;            ///< at least 3, 2 or 1
  std::int32_t material = kNoObjIndex;       ///< index into ObjFile::material_names
  std::uint32_t smoothing_group = 0;         ///< 0: off
};

struct ObjFile {
  std::vector<std::array<double, 3>> positions;  ///< x y z
  std::vector<float> colors;         ///< r g b per position, white where none is given; empty: none is given
  std::vector<bool> has_color;       ///< per position; empty: none is given
  std::vector<float> texcoords;      ///< s t, t upwards
  std::vector<float> normals;        ///< x y z, any length
  std::vector<ObjCorner> corners;    ///< corners of all elements, in order
  std::vector<ObjElement> elements;  ///< in the order of the file
  std::vector<std::string> material_names;  ///< names after usemtl, without repetitions
  std::vector<std::string> material_files;  ///< arguments of mtllib
  bool has_smoothing_groups = false;        ///< some line gives a smoothing group, or "off"
};

/// Reads the text of an OBJ file.
/// - An index of a normal or a texture coordinate that is empty or 0 means none, as does one beyond the last
///   texture coordinate.
/// - A vertex may have a colour: three more numbers.
/// - Keywords other than v, vt, vn, f, l, p, s, usemtl and mtllib are ignored.
/// @param file  for messages
/// @throws Error with file and line for a number that is missing, malformed or not finite, an element with
///   too few or too many corners, or an index that refers to no vertex or normal of an earlier line
ObjFile parse_obj(std::string_view text, const std::string& file, const ReportProgress& progress = {});

}  // namespace tessera::program
