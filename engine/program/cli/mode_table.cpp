#include "engine/program/cli/mode_table.h"

#include <algorithm>
#include <array>

#include <nlohmann/json.hpp>

#include "engine/program/cli/formatted.h"
#include "engine/program/compare/flip.h"
#include "engine/program/scene/dither_names.h"

namespace tessera::program::cli {
namespace {

constexpr std::size_t kColumns = 10;
using Cells = std::array<std::string, kColumns>;

constexpr std::size_t kTextColumns = 4;  ///< aligned to the left, unlike numbers

Cells cells_of(const ModeRow& row) {
  const DisplayMode& mode = row.group.mode;
  return {names_of(row.group),
          formatted("%dx%dx%d", mode.width, mode.height, mode.color_bits),
          std::string(dither_name(row.dither)),
          row.reduced ? "24 bits, reduced" : "directly",
          std::to_string(row.mode_bytes),
          std::to_string(row.buffer_bytes),
          formatted("%.2f", row.frame_ms),
          formatted("%.4f", row.flip_monitor),
          formatted("%.4f", row.flip_own),
          formatted("%.2f", own_pixels_per_degree(mode))};
}

std::string line_of(const Cells& cells, const std::array<std::size_t, kColumns>& widths) {
  std::string line;
  for (std::size_t i = 0; i < kColumns; ++i) {
    const std::string pad(widths[i] - cells[i].size(), ' ');
    line += (i == 0 ? "" : "  ") + (i < kTextColumns ? cells[i] + pad : pad + cells[i]);
  }
  return line + "\n";
}

/// Quotes a field that holds a comma.
std::string csv_field(const std::string& text) {
  return text.find(',') == std::string::npos ? text : "\"" + text + "\"";
}

}  // namespace

std::string table_text(std::span<const ModeRow> rows) {
  std::vector<Cells> lines{{"mode", "pixels x bits", "dither", "drawn", "mode bytes", "buffer bytes",
                            "frame ms", formatted("FLIP at %.2f", kDefaultPixelsPerDegree), "FLIP at own",
                            "own"}};
  for (const ModeRow& row : rows) lines.push_back(cells_of(row));
  std::array<std::size_t, kColumns> widths{};
  for (const Cells& line : lines)
    for (std::size_t i = 0; i < kColumns; ++i) widths[i] = std::max(widths[i], line[i].size());
  std::string text;
  for (const Cells& line : lines) text += line_of(line, widths);
  return text +
         formatted(
             "FLIP: mean difference from 24 bits, at %.2f pixels per degree (a modern monitor) and at "
             "the mode's own (\"own\": a ",
             kDefaultPixelsPerDegree) +
         "14-inch 4:3 screen seen from 50 cm); both are here because coarse dithers that look smooth on the "
         "former are seen as grain on the latter.\n";
}

std::string table_csv(std::span<const ModeRow> rows) {
  std::string text =
      "modes,width,height,bits,dither,reduced,mode_bytes,buffer_bytes,frame_ms,flip_monitor,flip_own,"
      "own_pixels_per_degree,picture,reference\n";
  for (const ModeRow& row : rows) {
    const DisplayMode& mode = row.group.mode;
    text +=
        csv_field(names_of(row.group)) + formatted(",%d,%d,%d,", mode.width, mode.height, mode.color_bits) +
        std::string(dither_name(row.dither)) +
        formatted(",%d,%zu,%zu,%.3f,%.6f,%.6f,%.4f,", row.reduced ? 1 : 0, row.mode_bytes, row.buffer_bytes,
                  row.frame_ms, row.flip_monitor, row.flip_own, own_pixels_per_degree(mode)) +
        row.picture + "," + row.reference + "\n";
  }
  return text;
}

std::string table_json(std::span<const ModeRow> rows, const std::string& scene) {
  nlohmann::ordered_json json{{"scene", scene.empty() ? "built-in" : scene},
                              {"monitor_pixels_per_degree", kDefaultPixelsPerDegree},
                              {"rows", nlohmann::ordered_json::array()}};
  for (const ModeRow& row : rows) {
    const DisplayMode& mode = row.group.mode;
    json["rows"].push_back({{"modes", row.group.names},
                            {"width", mode.width},
                            {"height", mode.height},
                            {"color_bits", mode.color_bits},
                            {"dither", dither_name(row.dither)},
                            {"reduced", row.reduced},
                            {"mode_bytes", row.mode_bytes},
                            {"buffer_bytes", row.buffer_bytes},
                            {"frame_ms", row.frame_ms},
                            {"flip_monitor", row.flip_monitor},
                            {"flip_own", row.flip_own},
                            {"own_pixels_per_degree", own_pixels_per_degree(mode)},
                            {"picture", row.picture},
                            {"reference", row.reference}});
  }
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace tessera::program::cli
