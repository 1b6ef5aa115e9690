#include "framebuffer/mode_table.h"

#include "framebuffer/check.h"
#include "framebuffer/format.h"

namespace tessera::detail {
namespace {

// Timing of the adapters: the values that the BIOS or drivers load into the CRT controller. From 800x600 on:
// VESA Monitor Timing Standards. The colour carrier of NTSC is 315/88 MHz.
constexpr double kCarrierHz = 315e6 / 88;
constexpr ScanTiming kMdaTiming{.pixel_clock_hz = 16.257e6, .total_columns = 882, .total_lines = 370};
// 54 characters of 16 columns; 92 * 4 + 2 lines.
constexpr ScanTiming kHerculesTiming{.pixel_clock_hz = 16.257e6, .total_columns = 864, .total_lines = 370};
// 14.31818 MHz is four carriers; 320 columns take half of it. 128 * 2 + 6 lines.
constexpr ScanTiming kCgaTiming{.pixel_clock_hz = 2 * kCarrierHz, .total_columns = 456, .total_lines = 262};
constexpr ScanTiming kCgaHiTiming{.pixel_clock_hz = 4 * kCarrierHz, .total_columns = 912, .total_lines = 262};
// 5Bh + 2 characters of 8 columns; 16Ch + 2 lines.
constexpr ScanTiming kEgaTiming{.pixel_clock_hz = 16.257e6, .total_columns = 744, .total_lines = 366};
constexpr ScanTiming kVgaTiming{.pixel_clock_hz = 25.175e6, .total_columns = 800, .total_lines = 525};
constexpr ScanTiming kVga13hTiming{
    .pixel_clock_hz = 12.5875e6, .total_columns = 400, .total_lines = 449, .lines_per_row = 2};
constexpr ScanTiming kVgaXTiming{
    .pixel_clock_hz = 12.5875e6, .total_columns = 400, .total_lines = 525, .lines_per_row = 2};
constexpr ScanTiming kSvga56Timing{.pixel_clock_hz = 36e6, .total_columns = 1024, .total_lines = 625};
constexpr ScanTiming kSvgaTiming{.pixel_clock_hz = 40e6, .total_columns = 1056, .total_lines = 628};
constexpr ScanTiming k8514Timing{
    .pixel_clock_hz = 44.9e6, .total_columns = 1264, .total_lines = 817, .interlaced = true};
constexpr ScanTiming kXgaTiming{.pixel_clock_hz = 65e6, .total_columns = 1344, .total_lines = 806};
constexpr ScanTiming kSxgaTiming{.pixel_clock_hz = 108e6, .total_columns = 1688, .total_lines = 1066};
constexpr ScanTiming kUxgaTiming{.pixel_clock_hz = 162e6, .total_columns = 2160, .total_lines = 1250};
constexpr ScanTiming k1920Timing{.pixel_clock_hz = 234e6, .total_columns = 2600, .total_lines = 1500};
// Low resolution has two pixels per colour clock.
constexpr ScanTiming kAmigaPalTiming{
    .pixel_clock_hz = 2 * 3.546895e6, .total_columns = 454, .total_lines = 313};
constexpr ScanTiming kAmigaNtscTiming{
    .pixel_clock_hz = 2 * kCarrierHz, .total_columns = 455, .total_lines = 262};

using enum ModeColors;
using enum MemoryLayout;
constexpr ModeRow kModes[] = {
    {"mda", "IBM MDA text, 80x25 characters", 720, 350, 1, components, character_cells, kMdaTiming},
    {"hercules", "Hercules graphics", 720, 348, 1, components, hercules_banks, kHerculesTiming},
    {"mono", "VGA, black and white", 640, 480, 1, components, packed, kVgaTiming},
    {"cga", "IBM CGA, 4 colours", 320, 200, 2, cga, cga_banks, kCgaTiming},
    {"cga-hi", "IBM CGA, black and white", 640, 200, 1, components, cga_banks, kCgaHiTiming},
    {"ega-lo", "IBM EGA, 16 colours", 320, 200, 4, rgbi16, planes, kCgaTiming},
    {"ega", "IBM EGA, 16 of 64 colours", 640, 350, 4, ega64, planes, kEgaTiming},
    {"vga", "IBM VGA, 16 of 262,144 colours", 640, 480, 4, vga262144, planes, kVgaTiming},
    {"vga13h", "IBM VGA mode 13h, 256 colours", 320, 200, 8, vga262144, packed, kVga13hTiming},
    {"vga-x", "VGA unchained, 256 colours", 320, 240, 8, vga262144, byte_planes, kVgaXTiming},
    {"svga56", "800x600 at 56 Hz, 256 colours", 800, 600, 8, vga262144, packed, kSvga56Timing},
    {"svga", "800x600, 256 colours", 800, 600, 8, vga262144, packed, kSvgaTiming},
    {"8514a", "IBM 8514/A, 256 colours", 1024, 768, 8, vga262144, packed, k8514Timing},
    {"xga", "1024x768, 256 colours", 1024, 768, 8, vga262144, packed, kXgaTiming},
    {"vga15", "640x480, 32,768 colours", 640, 480, 15, components, bytes, kVgaTiming},
    {"vga16", "640x480, high colour", 640, 480, 16, components, bytes, kVgaTiming},
    {"vga24", "640x480, true colour", 640, 480, 24, components, bytes, kVgaTiming},
    {"svga15", "800x600, 32,768 colours", 800, 600, 15, components, bytes, kSvgaTiming},
    {"svga16", "800x600, high colour", 800, 600, 16, components, bytes, kSvgaTiming},
    {"svga24", "800x600, true colour", 800, 600, 24, components, bytes, kSvgaTiming},
    {"xga24", "1024x768, true colour", 1024, 768, 24, components, bytes, kXgaTiming},
    {"sxga", "1280x1024, true colour", 1280, 1024, 24, components, bytes, kSxgaTiming},
    {"uxga", "1600x1200, true colour", 1600, 1200, 24, components, bytes, kUxgaTiming},
    {"vesa1920", "1920x1440, true colour", 1920, 1440, 24, components, bytes, k1920Timing},
    {"amiga", "Amiga PAL, 32 of 4,096 colours", 320, 256, 5, amiga4096, planes, kAmigaPalTiming},
    {"amiga-ntsc", "Amiga NTSC, 32 of 4,096 colours", 320, 200, 5, amiga4096, planes, kAmigaNtscTiming},
    // Panels of grey pixels have no standard size; these are typical.
    {"gray1", "panel, black and white", 400, 240, 1, components, packed, {}, PixelShape::square},
    {"gray2", "panel, 4 greys", 320, 240, 2, components, packed, {}, PixelShape::square},
    {"gray4", "panel, 16 greys", 800, 600, 4, greys, packed, {}, PixelShape::square},
};

/// A colour in levels of 4 bits.
constexpr Rgb8 from_4_bits(int r, int g, int b) {
  const auto level = [](int v) {
    return static_cast<std::uint8_t>(display_level(static_cast<std::uint32_t>(v), 4));
  };
  return {level(r), level(g), level(b)};
}

/// 32 colours for the Amiga, whose software chose its palettes: every mixture of components 0, 8 and 15 of
/// 15, and five greys between them.
std::vector<Rgb8> amiga32() {
  constexpr int kLevels[] = {0, 8, 15};
  constexpr int kGreys[] = {2, 4, 6, 10, 12};
  std::vector<Rgb8> entries;
  for (const int r : kLevels)
    for (const int g : kLevels)
      for (const int b : kLevels) entries.push_back(from_4_bits(r, g, b));
  for (const int v : kGreys) entries.push_back(from_4_bits(v, v, v));
  return entries;
}

}  // namespace

std::span<const ModeRow> mode_table() noexcept { return kModes; }

std::vector<Rgb8> cga_entries(const CgaColors& colors) {
  TESSERA_ASSERT(colors.background >= 0 && colors.background < 16);
  const std::vector<Rgb8> rgbi = *palette_entries("ega16", 4);
  constexpr std::size_t kColors[3][3] = {{2, 4, 6}, {3, 5, 7}, {3, 4, 7}};  // by CgaPalette
  constexpr std::size_t kIntensity = 8;
  std::vector<Rgb8> entries{rgbi[static_cast<std::size_t>(colors.background)]};
  for (const std::size_t color : kColors[static_cast<std::size_t>(colors.palette)])
    entries.push_back(rgbi[color + (colors.high_intensity ? kIntensity : 0)]);
  return entries;
}

std::vector<Rgb8> mode_entries(ModeColors colors, int bits) {
  switch (colors) {
    case components: return {};
    case greys: return *palette_entries("gray", bits);
    case cga: return cga_entries({});
    case amiga4096: return amiga32();
    case rgbi16:
    case ega64: return *palette_entries("ega16", 4);
    case vga262144: return default_palette_of(bits).entries;
  }
  return {};
}

bool is_converter_level(std::uint8_t level, int bits) noexcept {
  TESSERA_ASSERT(bits >= 1 && bits <= 8);
  const std::uint32_t max_level = (1u << bits) - 1;
  // The nearest level of the converter.
  const std::uint32_t v = (2 * level * max_level + 255) / (2 * 255);
  return display_level(v, bits) == level;
}

}  // namespace tessera::detail
