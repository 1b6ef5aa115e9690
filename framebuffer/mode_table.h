// Display modes as data: sizes, colours, timing and memory of old adapters and small panels.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "framebuffer/palette.h"
#include "framebuffer/tessera/memory_layout.hpp"
#include "framebuffer/tessera/scan_timing.hpp"

namespace tessera::detail {

/// Colours of a mode. For indices: its palette, and the bits per component of the colours that an entry may
/// have (0: the hardware gives the entries).
enum class ModeColors : std::uint8_t {
  components,  ///< RGB, or luminance at 1 and 2 bits: the pixel holds the levels
  greys,       ///< indices, 2^bits greys, fixed
  cga,         ///< indices, fixed but for the choices of CgaColors
  rgbi16,      ///< indices, the 16 colours of an RGBI monitor, fixed
  ega64,       ///< indices, 16 of the 64 colours of 2 bits per component
  amiga4096,   ///< indices, 32 of 4,096: 4 bits per component
  vga262144    ///< indices, of 262,144: 6 bits per component
};
/// Bits per component of the colours that palette entries may have; 0 if the palette is fixed or absent.
constexpr int palette_component_bits(ModeColors colors) {
  switch (colors) {
    case ModeColors::ega64: return 2;
    case ModeColors::amiga4096: return 4;
    case ModeColors::vga262144: return 6;
    default: return 0;
  }
}

/// Shape of the pixels.
enum class PixelShape : std::uint8_t {
  fills_4_by_3,  ///< the picture fills a 4:3 screen
  square
};

struct ModeRow {
  std::string_view name;
  std::string_view description;
  int width, height;  ///< pixels
  int bits;           ///< per pixel
  ModeColors colors;
  MemoryLayout layout;
  ScanTiming timing{};  ///< pixel clock 0: not a scanned display
  PixelShape shape = PixelShape::fills_4_by_3;
};
std::span<const ModeRow> mode_table() noexcept;

/// Three of the colours of CGA's 320x200 mode; the fourth is the background.
enum class CgaPalette : std::uint8_t {
  green_red_brown,     ///< palette 0
  cyan_magenta_white,  ///< palette 1
  cyan_red_white       ///< mode 5
};
/// Defaults: the BIOS loads 30h into the colour select register (palette 1, high intensity, background 0).
struct CgaColors {
  CgaPalette palette = CgaPalette::cyan_magenta_white;
  bool high_intensity = true;
  int background = 0;  ///< entry 0: one of the 16 RGBI colours
};
std::vector<Rgb8> cga_entries(const CgaColors& colors);

/// Default entries of a mode of `bits` bits. CGA: those of CgaColors{}. Empty for `components`.
std::vector<Rgb8> mode_entries(ModeColors colors, int bits);

/// Returns whether a converter of `bits` bits per component shows the 8-bit level: whether it is
/// round(255 v / (2^bits - 1)) for an integer v. @pre 1 <= bits <= 8
bool is_converter_level(std::uint8_t level, int bits) noexcept;

}  // namespace tessera::detail
