// Reads the values of PLY files, text and binary, in their order.
#pragma once

#include <cstdint>

#include "engine/program/import/model_file.h"
#include "engine/program/import/ply_header.h"

namespace tessera::program {

/// All functions throw Error with line or byte if the file ends, or if a word of text is not a number.
class PlyValues {
 public:
  PlyValues(ModelFile& file, PlyFormat format) : file_(file), format_(format) {}

  double number(PlyType type);
  /// For indices and lengths of lists. Values of floats are truncated, those beyond int64 become 2^63 - 1.
  std::int64_t integer(PlyType type);
  /// Returns the length of a list, which the rest of the file can hold.
  std::uint64_t list_length(const PlyProperty& list);
  void skip(const PlyProperty& property);
  /// How many of `count` elements the rest of the file can hold at most, for reserving memory.
  std::uint64_t plausible(const PlyElement& element) const;

  [[noreturn]] void fail(const std::string& what) const;

 private:
  template <class T>
  T binary();
  std::string_view word();

  ModelFile& file_;
  PlyFormat format_;
};

}  // namespace tessera::program
