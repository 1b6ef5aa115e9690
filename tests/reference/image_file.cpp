#include "image_file.h"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace tessera::reference {
namespace {

constexpr int kMaxSide = 16384;

/// Format: a header of numbers and comments, one byte of white space, then the rows from the top.
class PortableMap {
 public:
  explicit PortableMap(const std::vector<std::uint8_t>& bytes) : bytes_(bytes) {}

  Image read() {
    Image image;
    image.channels = bytes_[1] == '6' ? 3 : 1;
    at_ = 2;
    image.width = number(kMaxSide);
    image.height = number(kMaxSide);
    const auto largest = static_cast<unsigned>(number(65535));
    ++at_;
    const std::size_t row = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.channels);
    const std::size_t count = row * static_cast<std::size_t>(image.height);
    for (std::size_t i = 0; i < count; ++i) {
      unsigned value = next();
      if (largest > 255) value = value * 256 + next();
      image.levels.push_back(level_in_8_bits(std::min(value, largest), largest));
    }
    return image;
  }

 private:
  unsigned next() {
    if (at_ >= bytes_.size()) throw std::runtime_error("a file that ends early");
    return bytes_[at_++];
  }

  int number(int most) {
    while (at_ < bytes_.size() && (std::isspace(bytes_[at_]) != 0 || bytes_[at_] == '#')) {
      if (bytes_[at_] == '#')
        while (at_ < bytes_.size() && bytes_[at_] != '\n') ++at_;
      else ++at_;
    }
    int value = 0;
    while (at_ < bytes_.size() && std::isdigit(bytes_[at_]) != 0 && value <= most)
      value = 10 * value + (bytes_[at_++] - '0');
    if (value < 1 || value > most) throw std::runtime_error("a size that is not 1.." + std::to_string(most));
    return value;
  }

  const std::vector<std::uint8_t>& bytes_;
  std::size_t at_ = 0;
};

Image with_bottom_row_first(Image image) {
  const auto row = static_cast<std::ptrdiff_t>(image.width) * image.channels;
  for (std::ptrdiff_t low = 0, high = image.height - 1; low < high; ++low, --high)
    std::swap_ranges(image.levels.begin() + low * row, image.levels.begin() + (low + 1) * row,
                     image.levels.begin() + high * row);
  return image;
}

}  // namespace

std::uint8_t level_in_8_bits(unsigned value, unsigned largest) {
  return static_cast<std::uint8_t>((2 * 255 * value + largest) / (2 * largest));
}

Image read_image(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  const std::vector<std::uint8_t> bytes{std::istreambuf_iterator<char>(file),
                                        std::istreambuf_iterator<char>()};
  if (!file || bytes.size() < 2) throw std::runtime_error("no file, or an empty one: " + path);
  try {
    if (bytes[0] == 'P' && (bytes[1] == '5' || bytes[1] == '6'))
      return with_bottom_row_first(PortableMap(bytes).read());
    if (bytes[0] == 0x89 && bytes[1] == 'P') return with_bottom_row_first(read_png(bytes));
  } catch (const std::exception& e) {
    throw std::runtime_error(e.what() + (": " + path));
  }
  throw std::runtime_error("a file of another kind: " + path);
}

}  // namespace tessera::reference
