// The header of PLY files: which elements follow, and of which properties they are made.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "engine/program/import/model_file.h"

namespace tessera::program {

enum class PlyFormat : std::uint8_t { ascii, little_endian, big_endian };
enum class PlyType : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

/// Bytes of a value in the binary formats.
constexpr std::size_t size_of(PlyType type) {
  constexpr std::size_t kSizes[] = {1, 1, 2, 2, 4, 4, 4, 8};
  return kSizes[static_cast<std::size_t>(type)];
}
constexpr bool is_integer(PlyType type) { return type < PlyType::float32; }

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::float32;
  bool is_list = false;
  PlyType count_type = PlyType::uint8;  ///< type of a list's length
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;  ///< as the header claims
  std::vector<PlyProperty> properties;

  /// Number of the first property with one of these names that is a list or not; -1: there is none.
  int find(std::initializer_list<std::string_view> names, bool is_list = false) const;
  /// Fewest bytes of one element.
  std::uint64_t min_bytes(PlyFormat format) const;
};

struct PlyHeader {
  PlyFormat format = PlyFormat::ascii;
  std::vector<PlyElement> elements;
  std::string texture;                ///< file that `comment TextureFile` names; may be empty
  std::vector<std::string> warnings;  ///< without the file's name
};

/// Reads from `ply` to the line `end_header`. Lines may end with LF, CR LF or CR, but all in the same way.
/// @throws Error, naming the line
PlyHeader read_ply_header(ModelFile& file);

}  // namespace tessera::program
