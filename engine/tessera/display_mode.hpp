// Display modes: resolution, colours, timing and memory of old and small displays, as data.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <tessera/memory_layout.hpp>
#include <tessera/scan_timing.hpp>

#include "framebuffer.hpp"
#include "types.hpp"

namespace tessera {

/// Width : height, positive integers in lowest terms.
struct AspectRatio {
  int numerator = 1, denominator = 1;
  constexpr double value() const { return static_cast<double>(numerator) / denominator; }
};

/// A mode of a display adapter or a panel.
/// @code
/// const DisplayMode mode = display_mode("cga");  // or "320x200x8"
/// FrameBuffer cga(frame_buffer_format(mode));
/// std::printf("%d x %d, %.2f\n", mode.width, mode.height, mode.screen_aspect());
/// @endcode
struct DisplayMode {
  std::string name;         ///< as given to display_mode()
  std::string description;  ///< adapter and colours
  int width = 640;          ///< pixels, 1 to kMaxFrameBufferSize
  int height = 480;         ///< pixels, 1 to kMaxFrameBufferSize
  /// Width of a pixel to its height. Timed modes fill a 4:3 screen: 4 height / (3 width).
  AspectRatio pixel_aspect{};
  /// rgb: the pixel holds R:G:B, or luminance at 1 and 2 bits. index: a position in the palette.
  ColorMode color_mode = ColorMode::rgb;
  int color_bits = 24;  ///< bits of a pixel (planes), 1 to 24
  /// Colour-index modes: the default entries of the hardware, or the fixed ones. Empty for rgb.
  std::vector<Color> palette{};
  /// Bits per component of the colours that palette entries may have: 2 (EGA, 64 colours), 4 (Amiga, 4,096),
  /// 6 (VGA, 262,144) or 8. 0: the palette is fixed, or there is none.
  int palette_component_bits = 0;
  std::optional<ScanTiming> timing{};  ///< absent: not a scanned display, or no particular one
  MemoryLayout layout = MemoryLayout::bytes;
  ByteOrder byte_order = ByteOrder::little;  ///< MemoryLayout::bytes only

  /// Width to height of the picture on its screen.
  double screen_aspect() const { return pixel_aspect.value() * width / height; }
};

/// All named modes, with their default parameters. Sources: adapter registers and VESA timing standards; see
/// framebuffer/README.md. The table is constant; any thread may read it.
TESSERA_API std::span<const DisplayMode> display_modes();

/// A mode by its name, with parameters after a colon: "cga:palette=1,intensity=high,background=1".
/// - Names: those of display_modes(), or WIDTHxHEIGHTxBITS, for example "640x480x12".
/// - cga: `palette` 0 (green, red, brown), 1 (cyan, magenta, white; default) or mode5 (cyan, red, white);
///   `intensity` low or high (default); `background` 0 (default) to 15.
/// - RGB modes of 9 bits or more: `bytes` little (default) or big, the order of the bytes of a pixel.
/// - WIDTHxHEIGHTxBITS: `color` rgb, index or gray; default: index at 4 and 8 bits, else rgb. gray: 1 to 8
///   bits. `aspect` of a pixel as WIDTH:HEIGHT, each 1 to 255; default: 1:1.
///   Palettes are default_palette(bits), or greys. Memory: `packed` at 1, 2, 4 and 8 bits, `bytes` from 9
///   bits on, else `planes`.
/// @throws Error  for an unknown name or parameter, for sizes and bits out of range, and with
///                ErrorCode::unsupported for modes with colours per cell or relative to the neighbour (HAM)
TESSERA_API DisplayMode display_mode(std::string_view name);

/// The frame buffer of a mode: size, colour mode, bits and palette; other fields have their defaults.
/// @throws Error  for a mode of character cells, or if values of the mode do not fit together
TESSERA_API FrameBufferFormat frame_buffer_format(const DisplayMode& mode);

/// Checks that a mode can show a palette.
/// @throws Error  for an rgb mode, for a fixed palette other than the mode's, for 0 or more than 2^color_bits
///                entries, and for an entry whose colour the hardware cannot show; names the nearest one
TESSERA_API void check_palette(const DisplayMode& mode, std::span<const Color> palette);

/// Bytes of a picture in the memory of a mode, gaps between banks included.
/// @throws Error  as frame_buffer_format()
TESSERA_API std::size_t memory_bytes(const DisplayMode& mode);

/// Writes the picture of a frame buffer into the memory of a mode, byte for byte as its hardware had it.
/// - `words`: width * height colours as FrameBuffer::read_packed_colors() gives them; alpha is ignored.
/// - `memory`: memory_bytes(mode) bytes, all of which are written.
/// @throws Error  for other sizes, and as frame_buffer_format()
TESSERA_API void write_memory(const DisplayMode& mode, std::span<const std::uint32_t> words,
                              std::span<std::uint8_t> memory);

}  // namespace tessera
