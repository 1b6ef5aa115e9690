#include "engine/program/imageio/float_picture.h"

#include <bit>
#include <cstddef>

namespace tessera::program {

// The negative scale marks little-endian floats.
std::string encode_pfm(int width, int height, int channels, std::span<const float> values) {
  static_assert(std::endian::native == std::endian::little);
  const std::size_t row_floats = static_cast<std::size_t>(width) * static_cast<std::size_t>(channels);
  std::string file =
      (channels == 1 ? "Pf\n" : "PF\n") + std::to_string(width) + " " + std::to_string(height) + "\n-1.0\n";
  file.reserve(file.size() + values.size_bytes());
  for (int y = height - 1; y >= 0; --y) {
    const std::span<const float> row = values.subspan(static_cast<std::size_t>(y) * row_floats, row_floats);
    file.append(reinterpret_cast<const char*>(row.data()), row.size_bytes());
  }
  return file;
}

}  // namespace tessera::program
