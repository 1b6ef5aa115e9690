// Reads PNG files with libpng, without changing what their rows hold.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace tessera {

struct DecodedPng {
  int width = 0, height = 0, bits = 0, color = 0;
  std::vector<std::uint8_t> palette;            ///< r g b per entry
  std::vector<std::vector<std::uint8_t>> rows;  ///< as in the file, filters undone
};

/// @throws std::runtime_error with libpng's message; warnings are errors
DecodedPng read_by_libpng(const std::string& file);

}  // namespace tessera
