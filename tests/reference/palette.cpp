#include "palette.h"

#include <array>
#include <limits>
#include <set>
#include <stdexcept>

namespace tessera::reference {
namespace {

// The 16 colours of IBM CGA and EGA.
constexpr std::array<Rgb8, 16> kEga16{{{0, 0, 0},
                                       {0, 0, 170},
                                       {0, 170, 0},
                                       {0, 170, 170},
                                       {170, 0, 0},
                                       {170, 0, 170},
                                       {170, 85, 0},
                                       {170, 170, 170},
                                       {85, 85, 85},
                                       {85, 85, 255},
                                       {85, 255, 85},
                                       {85, 255, 255},
                                       {255, 85, 85},
                                       {255, 85, 255},
                                       {255, 255, 85},
                                       {255, 255, 255}}};

// The default palette of IBM VGA mode 13h: EGA's colours, 16 greys, 3 intensities x 3 saturations x 24 hues,
// 8 black entries. The values are 6-bit DAC levels.
constexpr std::array<int, 16> kVgaGrays{0, 5, 8, 11, 14, 17, 20, 24, 28, 32, 36, 40, 45, 50, 56, 63};
constexpr std::array<std::array<int, 5>, 9> kVgaRamps{{{0, 16, 31, 47, 63},
                                                       {31, 39, 47, 55, 63},
                                                       {45, 49, 54, 58, 63},
                                                       {0, 7, 14, 21, 28},
                                                       {14, 17, 21, 24, 28},
                                                       {20, 22, 24, 26, 28},
                                                       {0, 4, 8, 12, 16},
                                                       {8, 10, 12, 14, 16},
                                                       {11, 12, 13, 15, 16}}};

std::uint8_t dac_to_8_bits(int level) { return static_cast<std::uint8_t>(std::lround(255.0 * level / 63)); }

// One row of 24 hues: blue, +red, magenta, -blue, red, +green, yellow, -red, green, +blue, cyan, -green.
void append_hues(std::vector<Rgb8>& palette, const std::array<int, 5>& ramp) {
  struct Step {
    int component;
    int sign;
  };
  constexpr std::array<Step, 6> kSteps{{{0, +1}, {2, -1}, {1, +1}, {0, -1}, {2, +1}, {1, -1}}};
  std::array<int, 3> position{0, 0, 4};  // in the ramp, for R, G, B
  for (const Step step : kSteps)
    for (int i = 0; i < 4; ++i) {
      Rgb8 entry;
      for (std::size_t c = 0; c < 3; ++c)
        entry[c] = dac_to_8_bits(ramp[static_cast<std::size_t>(position[c])]);
      palette.push_back(entry);
      position[static_cast<std::size_t>(step.component)] += step.sign;
    }
}

std::vector<Rgb8> vga256() {
  std::vector<Rgb8> palette(kEga16.begin(), kEga16.end());
  for (const int gray : kVgaGrays)
    palette.push_back({dac_to_8_bits(gray), dac_to_8_bits(gray), dac_to_8_bits(gray)});
  for (const auto& ramp : kVgaRamps) append_hues(palette, ramp);
  palette.resize(256, Rgb8{0, 0, 0});
  return palette;
}

std::vector<Rgb8> web216() {
  const auto level = [](int i) { return static_cast<std::uint8_t>(51 * i); };
  std::vector<Rgb8> palette;
  for (int r = 0; r < 6; ++r)
    for (int g = 0; g < 6; ++g)
      for (int b = 0; b < 6; ++b) palette.push_back({level(r), level(g), level(b)});
  return palette;
}

std::vector<Rgb8> grays(std::uint32_t count) {
  std::vector<Rgb8> palette;
  for (std::uint32_t i = 0; i < count; ++i) {
    const auto level = static_cast<std::uint8_t>(std::lround(255.0 * i / (count - 1)));
    palette.push_back({level, level, level});
  }
  return palette;
}

}  // namespace

std::vector<Rgb8> named_palette(const std::string& name, int bits) {
  std::vector<Rgb8> palette;
  if (name == "bw") palette = grays(2);
  else if (name == "gray") palette = grays(1u << bits);
  else if (name == "ega16") palette.assign(kEga16.begin(), kEga16.end());
  else if (name == "vga256") palette = vga256();
  else if (name == "web216") palette = web216();
  else throw std::runtime_error("unknown palette: " + name);
  if (palette.size() > (std::size_t{1} << bits))
    throw std::runtime_error("palette " + name + " has too many entries for the buffer");
  return palette;
}

std::vector<Rgb8> default_palette(int bits) {
  if (bits == 1) return named_palette("bw", bits);
  if (bits <= 3) return named_palette("gray", bits);
  return named_palette(bits <= 7 ? "ega16" : "vga256", bits);
}

NearestEntry::NearestEntry(const std::vector<Rgb8>& palette) {
  std::set<Rgb8> seen;
  for (std::size_t i = 0; i < palette.size(); ++i)
    if (seen.insert(palette[i]).second)
      distinct_.push_back({{palette[i][0] / 255.0, palette[i][1] / 255.0, palette[i][2] / 255.0},
                           static_cast<std::uint32_t>(i)});
}

std::uint32_t NearestEntry::operator()(Vec3 color) const {
  double least = std::numeric_limits<double>::infinity();
  std::uint32_t nearest = 0;
  for (const Entry& entry : distinct_) {
    const Vec3 difference = color - entry.color;
    if (const double distance = dot(difference, difference); distance < least) {
      least = distance;
      nearest = entry.index;
    }
  }
  return nearest;
}

}  // namespace tessera::reference
