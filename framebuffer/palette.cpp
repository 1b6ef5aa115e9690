#include "framebuffer/palette.h"

#include <array>
#include <cstddef>

#include "framebuffer/format.h"

namespace tessera::detail {

namespace {

constexpr std::array<Rgb8, 16> kEga16 = {{{0, 0, 0},
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

// Default palette of VGA mode 13h (IBM VGA BIOS), in the 6-bit levels of its DAC.
constexpr std::array<int, 16> kVgaGreys = {0, 5, 8, 11, 14, 17, 20, 24, 28, 32, 36, 40, 45, 50, 56, 63};
/// Component levels along one leg of the hue circle, low to high: [intensity][saturation][step].
constexpr int kVgaHueLevels[3][3][5] = {{{0, 16, 31, 47, 63}, {31, 39, 47, 55, 63}, {45, 49, 54, 58, 63}},
                                        {{0, 7, 14, 21, 28}, {14, 17, 21, 24, 28}, {20, 22, 24, 26, 28}},
                                        {{0, 4, 8, 12, 16}, {8, 10, 12, 14, 16}, {11, 12, 13, 15, 16}}};

/// 6-bit level -> 8-bit level: round(255 v / 63).
constexpr std::uint8_t from_6_bits(int v) {
  return static_cast<std::uint8_t>(display_level(static_cast<std::uint32_t>(v), 6));
}

/// Hue h of the circle, 0 .. 23: blue, magenta, red, yellow, green, cyan at multiples of 4. On each leg one
/// component changes in four steps; the other two stay at the lowest or highest level.
Rgb8 vga_hue(int h, const int (&levels)[5]) {
  const std::uint8_t low = from_6_bits(levels[0]), high = from_6_bits(levels[4]);
  const std::uint8_t rising = from_6_bits(levels[h % 4]), falling = from_6_bits(levels[4 - h % 4]);
  switch (h / 4) {
    case 0: return {rising, low, high};    // blue -> magenta
    case 1: return {high, low, falling};   // magenta -> red
    case 2: return {high, rising, low};    // red -> yellow
    case 3: return {falling, high, low};   // yellow -> green
    case 4: return {low, high, rising};    // green -> cyan
    default: return {low, falling, high};  // cyan -> blue
  }
}

std::vector<Rgb8> vga256() {
  std::vector<Rgb8> entries(kEga16.begin(), kEga16.end());
  for (int v : kVgaGreys) entries.push_back({from_6_bits(v), from_6_bits(v), from_6_bits(v)});
  for (const auto& intensity : kVgaHueLevels)
    for (const auto& saturation : intensity)
      for (int h = 0; h < 24; ++h) entries.push_back(vga_hue(h, saturation));
  entries.resize(256);  // the last 8 are black
  return entries;
}

std::vector<Rgb8> greys(int bits) {
  std::vector<Rgb8> entries(std::size_t{1} << bits);
  for (std::size_t i = 0; i < entries.size(); ++i) {
    // display_level(i, bits) in 64 bits: 2 * 255 * 2^24 exceeds 32 bits.
    const std::uint64_t last = entries.size() - 1;
    const auto level = static_cast<std::uint8_t>((2 * 255 * std::uint64_t{i} + last) / (2 * last));
    entries[i] = {level, level, level};
  }
  return entries;
}

/// 6 x 6 x 6 colours, index 36 r + 6 g + b.
std::vector<Rgb8> web216() {
  std::vector<Rgb8> entries;
  for (int r = 0; r <= 255; r += 51)
    for (int g = 0; g <= 255; g += 51)
      for (int b = 0; b <= 255; b += 51)
        entries.push_back(
            {static_cast<std::uint8_t>(r), static_cast<std::uint8_t>(g), static_cast<std::uint8_t>(b)});
  return entries;
}

}  // namespace

Rgb8 quantize_rgb8(float r, float g, float b) noexcept {
  return {static_cast<std::uint8_t>(quantize(r, 8)), static_cast<std::uint8_t>(quantize(g, 8)),
          static_cast<std::uint8_t>(quantize(b, 8))};
}

std::optional<std::vector<Rgb8>> palette_entries(std::string_view name, int bits) {
  TESSERA_ASSERT(bits >= 1 && bits <= 24);
  if (name == "bw") return std::vector<Rgb8>{{0, 0, 0}, {255, 255, 255}};
  if (name == "gray") return greys(bits);
  if (name == "ega16") return std::vector<Rgb8>(kEga16.begin(), kEga16.end());
  if (name == "vga256") return vga256();
  if (name == "web216") return web216();
  return std::nullopt;
}

std::string_view default_palette_name(int bits) noexcept {
  if (bits == 1) return "bw";
  if (bits <= 3) return "gray";
  return bits <= 7 ? "ega16" : "vga256";
}

Palette default_palette_of(int bits) {
  return {.bits = bits, .entries = *palette_entries(default_palette_name(bits), bits)};
}

}  // namespace tessera::detail
