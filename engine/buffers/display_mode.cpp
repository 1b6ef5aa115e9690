// The table of display modes, their frame buffers, palettes and memory.
#include "engine/tessera/display_mode.hpp"

#include <numeric>
#include <string>

#include "engine/buffers/display_mode_state.h"
#include "engine/record/checks.h"
#include "engine/runtime/floating_point_mode.h"
#include "engine/runtime/out_of_memory.h"
#include "framebuffer/memory_image.h"
#include "framebuffer/mode_table.h"

namespace tessera {
using namespace detail;

namespace detail {

AspectRatio lowest_terms(int numerator, int denominator) {
  const int divisor = std::gcd(numerator, denominator);
  return {numerator / divisor, denominator / divisor};
}

std::vector<Color> colors_of(const std::vector<Rgb8>& entries) {
  std::vector<Color> colors;
  colors.reserve(entries.size());
  for (const Rgb8& entry : entries)
    colors.push_back({entry.r / 255.0f, entry.g / 255.0f, entry.b / 255.0f, 1});
  return colors;
}

}  // namespace detail

namespace {

/// Pixel aspect of a picture that fills a 4:3 screen.
AspectRatio four_by_three_aspect(int width, int height) { return lowest_terms(4 * height, 3 * width); }

DisplayMode mode_of(const ModeRow& row) {
  DisplayMode mode{.name = std::string(row.name),
                   .description = std::string(row.description),
                   .width = row.width,
                   .height = row.height,
                   .color_mode = row.colors == ModeColors::components ? ColorMode::rgb : ColorMode::index,
                   .color_bits = row.bits,
                   .palette = colors_of(mode_entries(row.colors, row.bits)),
                   .palette_component_bits = palette_component_bits(row.colors),
                   .layout = row.layout};
  if (row.shape == PixelShape::fills_4_by_3) mode.pixel_aspect = four_by_three_aspect(row.width, row.height);
  if (row.timing.pixel_clock_hz > 0) mode.timing = row.timing;
  return mode;
}

MemoryShape memory_shape(const DisplayMode& mode) {
  return {.layout = mode.layout,
          .byte_order = mode.byte_order,
          .width = mode.width,
          .height = mode.height,
          .bits = mode.color_bits};
}

[[noreturn]] void refuse_mode(const char* function, const std::string& message,
                              ErrorCode code = ErrorCode::invalid_argument) {
  throw Error(code, std::string(function) + ": " + message);
}

void require_mode_range(const char* function, const char* field, int value, int low, int high) {
  if (value < low || value > high)
    refuse_mode(function, std::string("the mode's ") + field + " is " + std::to_string(value) + ", must be " +
                              std::to_string(low) + " to " + std::to_string(high));
}

/// Whether rows of packed pixels of the mode fit into `banks` banks of 8,192 bytes.
bool fits_banks(const DisplayMode& mode, int banks) {
  const int row_bytes = (mode.width * mode.color_bits + 7) / 8;
  return mode.color_bits <= 2 && (mode.height + banks - 1) / banks * row_bytes <= 0x2000;
}

/// The condition that a layout sets on a mode, as text; empty if it holds.
std::string broken_layout_condition(const DisplayMode& mode) {
  const bool bits_divide_byte = mode.color_bits <= 8 && 8 % mode.color_bits == 0;
  switch (mode.layout) {
    case MemoryLayout::packed: return bits_divide_byte ? "" : "packed pixels take 1, 2, 4 or 8 bits";
    case MemoryLayout::cga_banks:
      return fits_banks(mode, 2) ? "" : "CGA's memory is two banks of 8,192 bytes of 1 or 2 bits per pixel";
    case MemoryLayout::hercules_banks:
      return fits_banks(mode, 4) ? ""
                                 : "Hercules memory is four banks of 8,192 bytes of 1 or 2 bits per pixel";
    case MemoryLayout::byte_planes:
      return mode.color_bits == 8 && mode.width % 4 == 0
                 ? ""
                 : "byte planes take 8 bits per pixel and a width that is a multiple of 4";
    default: return "";
  }
}

std::string color_text(const Rgb8& color) {
  return "(" + std::to_string(color.r) + ", " + std::to_string(color.g) + ", " + std::to_string(color.b) +
         ")";
}

/// The nearest 8-bit level that a converter of `bits` bits per component shows; the lower one of two.
std::uint8_t nearest_converter_level(std::uint8_t level, int bits) {
  for (int distance = 0; distance < 256; ++distance)
    for (const int candidate : {level - distance, level + distance})
      if (candidate >= 0 && candidate <= 255 &&
          is_converter_level(static_cast<std::uint8_t>(candidate), bits))
        return static_cast<std::uint8_t>(candidate);
  return 0;
}

std::vector<Rgb8> quantized_palette(std::span<const Color> palette, const char* function) {
  std::vector<Rgb8> entries;
  for (std::size_t i = 0; i < palette.size(); ++i) {
    const Color& c = palette[i];
    for (const float component : {c.r, c.g, c.b})
      if (!(component >= 0 && component <= 1))
        refuse_mode(function, "palette entry " + std::to_string(i) + " has a component " +
                                  format_number(component) + ", must be 0 to 1");
    entries.push_back(quantize_rgb8(c.r, c.g, c.b));
  }
  return entries;
}

void check_fixed_palette(const DisplayMode& mode, const std::vector<Rgb8>& entries, const char* function) {
  if (entries == quantized_palette(mode.palette, function)) return;
  refuse_mode(function, "the palette of mode \"" + mode.name + "\" is fixed and cannot be replaced");
}

void check_possible_colors(const DisplayMode& mode, const std::vector<Rgb8>& entries, const char* function) {
  const int bits = mode.palette_component_bits;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const Rgb8 nearest{nearest_converter_level(entries[i].r, bits),
                       nearest_converter_level(entries[i].g, bits),
                       nearest_converter_level(entries[i].b, bits)};
    if (!(nearest == entries[i]))
      refuse_mode(function, "palette entry " + std::to_string(i) + " is " + color_text(entries[i]) +
                                ", which mode \"" + mode.name + "\" cannot show: its components have " +
                                std::to_string(bits) + " bits; the nearest colour is " + color_text(nearest));
  }
}

void check_mode_palette(const DisplayMode& mode, std::span<const Color> palette, const char* function) {
  if (mode.color_mode != ColorMode::index)
    refuse_mode(function, "mode \"" + mode.name + "\" has no palette: its pixels hold colour components",
                ErrorCode::incompatible_format);
  const std::size_t max_entries = std::size_t{1} << mode.color_bits;
  if (palette.empty() || palette.size() > max_entries)
    refuse_mode(function, "the palette has " + std::to_string(palette.size()) + " entries, mode \"" +
                              mode.name + "\" takes 1 to " + std::to_string(max_entries));
  const std::vector<Rgb8> entries = quantized_palette(palette, function);
  if (mode.palette_component_bits == 0) check_fixed_palette(mode, entries, function);
  else check_possible_colors(mode, entries, function);
}

}  // namespace

namespace detail {

void check_display_mode(const DisplayMode& mode, const char* function) {
  require_mode_range(function, "width", mode.width, 1, kMaxFrameBufferSize);
  require_mode_range(function, "height", mode.height, 1, kMaxFrameBufferSize);
  require_mode_range(function, "number of colour bits", mode.color_bits, 1, 24);
  require_mode_range(function, "palette_component_bits", mode.palette_component_bits, 0, 8);
  require_enum({function, ": color_mode"}, mode.color_mode, ColorMode::index);
  require_enum({function, ": layout"}, mode.layout, MemoryLayout::character_cells);
  require_enum({function, ": byte_order"}, mode.byte_order, ByteOrder::big);
  if (mode.layout == MemoryLayout::character_cells)
    refuse_mode(function, "mode \"" + mode.name + "\" has character cells, whose pixels cannot be stored",
                ErrorCode::unsupported);
  if (const std::string condition = broken_layout_condition(mode); !condition.empty())
    refuse_mode(function, "the mode is " + std::to_string(mode.width) + "x" + std::to_string(mode.height) +
                              "x" + std::to_string(mode.color_bits) + ", and " + condition);
  if (mode.color_mode == ColorMode::index) check_mode_palette(mode, mode.palette, function);
  else if (!mode.palette.empty())
    refuse_mode(function,
                "the mode has a palette, and its colour mode is rgb; palettes belong to index modes");
}

}  // namespace detail

std::span<const DisplayMode> display_modes() {
  return translate_bad_alloc("display_modes", []() -> std::span<const DisplayMode> {
    static const std::vector<DisplayMode> modes = [] {
      const FloatingPointMode floating_point;
      std::vector<DisplayMode> all;
      for (const ModeRow& row : mode_table()) all.push_back(mode_of(row));
      return all;
    }();
    return modes;
  });
}

FrameBufferFormat frame_buffer_format(const DisplayMode& mode) {
  constexpr const char* kFunction = "frame_buffer_format";
  const FloatingPointMode floating_point;
  return translate_bad_alloc(kFunction, [&] {
    check_display_mode(mode, kFunction);
    return FrameBufferFormat{.width = mode.width,
                             .height = mode.height,
                             .color_mode = mode.color_mode,
                             .color_bits = mode.color_bits,
                             .palette = mode.palette};
  });
}

void check_palette(const DisplayMode& mode, std::span<const Color> palette) {
  constexpr const char* kFunction = "check_palette";
  const FloatingPointMode floating_point;
  translate_bad_alloc(kFunction, [&] {
    check_display_mode(mode, kFunction);
    check_mode_palette(mode, palette, kFunction);
  });
}

std::size_t memory_bytes(const DisplayMode& mode) {
  constexpr const char* kFunction = "memory_bytes";
  const FloatingPointMode floating_point;
  return translate_bad_alloc(kFunction, [&] {
    check_display_mode(mode, kFunction);
    return memory_image_bytes(memory_shape(mode));
  });
}

void write_memory(const DisplayMode& mode, std::span<const std::uint32_t> words,
                  std::span<std::uint8_t> memory) {
  constexpr const char* kFunction = "write_memory";
  const FloatingPointMode floating_point;
  translate_bad_alloc(kFunction, [&] {
    check_display_mode(mode, kFunction);
    const MemoryShape shape = memory_shape(mode);
    const std::size_t pixels = static_cast<std::size_t>(mode.width) * static_cast<std::size_t>(mode.height);
    if (words.size() != pixels)
      refuse_mode(kFunction, "there are " + std::to_string(words.size()) + " words, mode \"" + mode.name +
                                 "\" has " + std::to_string(pixels) + " pixels");
    if (memory.size() != memory_image_bytes(shape))
      refuse_mode(kFunction, "the memory has " + std::to_string(memory.size()) + " bytes, mode \"" +
                                 mode.name + "\" takes " + std::to_string(memory_image_bytes(shape)));
    write_memory_image(shape, words, memory);
  });
}

}  // namespace tessera
