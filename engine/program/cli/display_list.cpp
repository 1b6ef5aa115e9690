#include "engine/program/cli/display_list.h"

#include <algorithm>
#include <array>
#include <vector>

#include <nlohmann/json.hpp>

#include "framebuffer/tessera/display.hpp"

namespace tessera::program::cli {
namespace {

using Json = nlohmann::ordered_json;
using Line = std::array<std::string, 4>;

/// Lines of columns, each as wide as its longest text.
std::string table_text(const std::vector<Line>& lines) {
  std::array<std::size_t, std::tuple_size_v<Line>> widths{};
  for (const Line& line : lines)
    for (std::size_t c = 0; c < line.size(); ++c) widths[c] = std::max(widths[c], line[c].size());
  std::string text;
  for (const Line& line : lines) {
    for (std::size_t c = 0; c < line.size(); ++c) {
      text += "  " + line[c];
      if (c + 1 < line.size()) text.append(widths[c] - line[c].size(), ' ');
    }
    text += "\n";
  }
  return text;
}

std::string with_source(std::string_view description, std::string_view source) {
  return std::string(description) + " (" + std::string(source) + ")";
}

Line line_of(const DisplayParameter& parameter) {
  std::string values = parameter.values;
  if (!parameter.unit.empty()) values += ", " + std::string(parameter.unit);
  return {std::string(parameter.name), parameter.default_value, values,
          with_source(parameter.description, parameter.source)};
}

bool is_in(const std::vector<DisplayParameter>& list, const DisplayParameter& parameter) {
  return std::any_of(list.begin(), list.end(), [&](const DisplayParameter& other) {
    return other.name == parameter.name && other.default_value == parameter.default_value;
  });
}

std::string kind_text(const NamedDisplayKind& kind) {
  const bool has_signal = kind.kind == DisplayKind::ntsc || kind.kind == DisplayKind::pal;
  const std::vector<DisplayParameter> of_crt = display_parameters(DisplayKind::crt);
  std::vector<Line> lines{{"parameter", "default", "values", "description (source of the default)"}};
  for (const DisplayParameter& parameter : display_parameters(kind.kind))
    if (!has_signal || !is_in(of_crt, parameter)) lines.push_back(line_of(parameter));
  return std::string(kind.name) + ": " + std::string(kind.description) + "\n" + table_text(lines) +
         (has_signal ? "  and the other parameters of crt\n" : "") + "\n";
}

std::string presets_text() {
  std::vector<Line> lines{{"preset", "typical mode", "definition", "description (source)"}};
  for (const DisplayPreset& preset : display_presets())
    lines.push_back({std::string(preset.name), std::string(preset.mode), std::string(preset.definition),
                     with_source(preset.description, preset.source)});
  return "Presets\n" + table_text(lines);
}

Json json_of(const DisplayParameter& parameter) {
  return {{"name", parameter.name},
          {"unit", parameter.unit},
          {"values", parameter.values},
          {"default", parameter.default_value},
          {"description", parameter.description},
          {"source", parameter.source}};
}

Json json_of(const NamedDisplayKind& kind) {
  Json json{{"name", kind.name}, {"description", kind.description}, {"parameters", Json::array()}};
  for (const DisplayParameter& parameter : display_parameters(kind.kind))
    json["parameters"].push_back(json_of(parameter));
  return json;
}

Json json_of(const DisplayPreset& preset) {
  return {{"name", preset.name},
          {"definition", preset.definition},
          {"mode", preset.mode},
          {"description", preset.description},
          {"source", preset.source}};
}

}  // namespace

std::string display_list_text() {
  std::string text;
  for (const NamedDisplayKind& kind : display_kinds()) text += kind_text(kind);
  return text + presets_text() +
         "NAME:PARAMETER=VALUE,... changes a kind or a preset: trinitron17:white=6500,beam=0.3\n";
}

std::string display_list_json() {
  Json json{{"kinds", Json::array()}, {"presets", Json::array()}};
  for (const NamedDisplayKind& kind : display_kinds()) json["kinds"].push_back(json_of(kind));
  for (const DisplayPreset& preset : display_presets()) json["presets"].push_back(json_of(preset));
  return json.dump(2) + "\n";
}

}  // namespace tessera::program::cli
