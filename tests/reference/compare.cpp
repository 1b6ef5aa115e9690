#include "compare.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace tessera::reference {
namespace {

std::size_t byte_at(int x, int y, int channel, int width_px) {
  return (static_cast<std::size_t>(y) * static_cast<std::size_t>(width_px) + static_cast<std::size_t>(x)) *
             3 +
         static_cast<std::size_t>(channel);
}

bool is_interior(std::span<const std::uint8_t> rgb, int x, int y, int width_px, int height_px) {
  for (int channel = 0; channel < 3; ++channel) {
    int least = 255;
    int most = 0;
    for (int ny = std::max(0, y - 1); ny <= std::min(height_px - 1, y + 1); ++ny)
      for (int nx = std::max(0, x - 1); nx <= std::min(width_px - 1, x + 1); ++nx) {
        const int level = rgb[byte_at(nx, ny, channel, width_px)];
        least = std::min(least, level);
        most = std::max(most, level);
      }
    if (most - least >= kInteriorSpan) return false;
  }
  return true;
}

void count(Counts& counts, int apart) {
  ++counts.pixels;
  if (apart > kTolerance) ++counts.differing;
  counts.largest = std::max(counts.largest, apart);
}

void require_size(std::span<const std::uint8_t> rgb, int width_px, int height_px) {
  if (rgb.size() != byte_at(0, height_px, 0, width_px))
    throw std::runtime_error("a picture has " + std::to_string(rgb.size()) +
                             " bytes, not width * height * 3");
}

}  // namespace

Comparison compare(std::span<const std::uint8_t> reference, std::span<const std::uint8_t> other, int width_px,
                   int height_px) {
  require_size(reference, width_px, height_px);
  require_size(other, width_px, height_px);
  Comparison result;
  for (int y = 0; y < height_px; ++y)
    for (int x = 0; x < width_px; ++x) {
      int apart = 0;
      for (int channel = 0; channel < 3; ++channel) {
        const std::size_t at = byte_at(x, y, channel, width_px);
        apart = std::max(apart, std::abs(int{reference[at]} - int{other[at]}));
      }
      count(result.all, apart);
      if (is_interior(reference, x, y, width_px, height_px)) count(result.interior, apart);
    }
  return result;
}

std::string to_string(const Comparison& comparison) {
  std::ostringstream line;
  const auto append = [&](const char* name, const Counts& counts) {
    line << name << ": " << counts.differing << " of " << counts.pixels << " pixels differ ("
         << 100 * counts.share() << " %), by at most " << counts.largest;
  };
  append("interior", comparison.interior);
  append("; all", comparison.all);
  return line.str();
}

std::vector<std::uint8_t> difference(std::span<const std::uint8_t> reference,
                                     std::span<const std::uint8_t> other, int gain) {
  if (reference.size() != other.size())
    throw std::runtime_error("pictures of different sizes have no difference");
  std::vector<std::uint8_t> result(reference.size());
  for (std::size_t i = 0; i < result.size(); ++i)
    result[i] = static_cast<std::uint8_t>(std::min(255, gain * std::abs(int{reference[i]} - int{other[i]})));
  return result;
}

void write_ppm(const std::string& path, std::span<const std::uint8_t> rgb, int width_px, int height_px) {
  require_size(rgb, width_px, height_px);
  std::ofstream file(path, std::ios::binary);
  file << "P6\n" << width_px << ' ' << height_px << "\n255\n";
  file.write(reinterpret_cast<const char*>(rgb.data()), static_cast<std::streamsize>(rgb.size()));
  if (!file) throw std::runtime_error("cannot write " + path);
}

void write_pictures(const std::string& stem, std::span<const std::uint8_t> reference,
                    std::span<const std::uint8_t> other, int width_px, int height_px) {
  write_ppm(stem + "_reference.ppm", reference, width_px, height_px);
  write_ppm(stem + "_other.ppm", other, width_px, height_px);
  write_ppm(stem + "_difference.ppm", difference(reference, other), width_px, height_px);
}

}  // namespace tessera::reference
