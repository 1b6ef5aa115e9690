#include "engine/program/cli/modes_command.h"

#include <cmath>
#include <optional>
#include <string_view>

#include <nlohmann/json.hpp>

#include "engine/program/cli/formatted.h"
#include "engine/program/cli/mode_selection.h"
#include "engine/tessera/display_mode.hpp"
#include "engine/tessera/screen_geometry.hpp"

namespace tessera::program::cli {
namespace {

using Json = nlohmann::ordered_json;

/// Dot pitches of the list, millimetres: a standard, a fine and a late colour tube.
constexpr double kPitches[] = {0.39, 0.28, 0.22};

std::string_view layout_name(MemoryLayout layout) {
  switch (layout) {
    case MemoryLayout::packed: return "packed";
    case MemoryLayout::cga_banks: return "cga_banks";
    case MemoryLayout::hercules_banks: return "hercules_banks";
    case MemoryLayout::planes: return "planes";
    case MemoryLayout::byte_planes: return "byte_planes";
    case MemoryLayout::bytes: return "bytes";
    case MemoryLayout::character_cells: return "character_cells";
  }
  return "";
}

/// Diagonal in inches rounded up to a tenth, on which the mode is sharp. Tubes only: the pixels of a panel
/// are its dots.
std::optional<double> listed_diagonal(const DisplayMode& mode, double pitch_mm) {
  if (!mode.timing || !has_pixels(mode)) return std::nullopt;
  return std::ceil(10 * sharp_diagonal_in(mode, pitch_mm)) / 10;
}

std::string list_line(const DisplayMode& mode) {
  const std::string size = formatted("%dx%dx%d", mode.width, mode.height, mode.color_bits);
  const std::string aspect = formatted("%d:%d", mode.pixel_aspect.numerator, mode.pixel_aspect.denominator);
  std::string line = formatted("%-10s  %-12s  %6s", mode.name.c_str(), size.c_str(), aspect.c_str());
  if (mode.timing) {
    line += formatted("  %7.3f  %7.3f", mode.timing->line_rate_hz() / 1000, mode.timing->frame_rate_hz());
    line += mode.timing->interlaced ? "i" : " ";
  } else {
    line += "        -        - ";
  }
  line += has_pixels(mode) ? formatted("  %8zu", memory_bytes(mode)) : "         -";
  for (const double pitch : kPitches) {
    const auto diagonal = listed_diagonal(mode, pitch);
    line += diagonal ? formatted("  %4.1f", *diagonal) : "     -";
  }
  return line + "  " + mode.description + "\n";
}

std::string list_text() {
  std::string text =
      "                                                                sharp from inches\n"
      "                             pixel     line    frame                  at pitch mm\n"
      "name        pixels x bits   aspect      kHz       Hz      bytes";
  for (const double pitch : kPitches) text += formatted("  %4.2f", pitch);
  text += "  description\n";
  for (const DisplayMode& mode : display_modes()) text += list_line(mode);
  return text +
         "WIDTHxHEIGHTxBITS names any other mode of 1 to 24 bits. Interlaced frames (i) are two fields.\n";
}

Json json_of(const DisplayMode& mode) {
  Json json{{"name", mode.name},
            {"description", mode.description},
            {"width", mode.width},
            {"height", mode.height},
            {"color_bits", mode.color_bits},
            {"color_mode", mode.color_mode == ColorMode::index ? "index" : "rgb"},
            {"palette_component_bits", mode.palette_component_bits},
            {"pixel_aspect", {mode.pixel_aspect.numerator, mode.pixel_aspect.denominator}},
            {"layout", layout_name(mode.layout)}};
  if (has_pixels(mode)) json["memory_bytes"] = memory_bytes(mode);
  if (mode.timing)
    json["timing"] = {
        {"pixel_clock_hz", mode.timing->pixel_clock_hz}, {"total_columns", mode.timing->total_columns},
        {"total_lines", mode.timing->total_lines},       {"lines_per_row", mode.timing->lines_per_row},
        {"interlaced", mode.timing->interlaced},         {"line_rate_hz", mode.timing->line_rate_hz()},
        {"frame_rate_hz", mode.timing->frame_rate_hz()}, {"field_rate_hz", mode.timing->field_rate_hz()}};
  if (mode.timing && has_pixels(mode))
    for (const double pitch : kPitches)
      json["sharp_from"].push_back({{"pitch_mm", pitch}, {"diagonal_in", sharp_diagonal_in(mode, pitch)}});
  return json;
}

std::string list_json() {
  Json json{{"modes", Json::array()}};
  for (const DisplayMode& mode : display_modes()) json["modes"].push_back(json_of(mode));
  return json.dump(2) + "\n";
}

std::string screen_text(const ModesRequest& request, const ScreenResolution& screen) {
  return formatted("%g-inch screen, %g mm: %.2f x %.2f inches, %.0f x %.0f dots; standard mode: %dx%d\n",
                   request.diagonal_in, request.pitch_mm, screen.width_in, screen.height_in,
                   std::floor(screen.columns), std::floor(screen.rows), screen.mode_width,
                   screen.mode_height);
}

std::string screen_json(const ModesRequest& request, const ScreenResolution& screen) {
  return Json{{"diagonal_in", request.diagonal_in},
              {"pitch_mm", request.pitch_mm},
              {"width_in", screen.width_in},
              {"height_in", screen.height_in},
              {"columns", screen.columns},
              {"rows", screen.rows},
              {"mode", {{"width", screen.mode_width}, {"height", screen.mode_height}}}}
             .dump(2) +
         "\n";
}

}  // namespace

std::string modes_text(const ModesRequest& request) {
  if (request.diagonal_in == 0) return request.json ? list_json() : list_text();
  const ScreenResolution screen = screen_resolution(request.diagonal_in, request.pitch_mm);
  return request.json ? screen_json(request, screen) : screen_text(request, screen);
}

}  // namespace tessera::program::cli
