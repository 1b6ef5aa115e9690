#include "engine/program/cli/color_command.h"

#include <iostream>

#include <nlohmann/json.hpp>

#include "engine/program/cli/color_space_choice.h"
#include "engine/program/cli/color_values.h"
#include "engine/program/cli/formatted.h"

namespace tessera::program::cli {
namespace {

using Json = nlohmann::ordered_json;

bool has_curve(const NamedColorSpace& named) { return named.space.model == ColorModel::rgb; }

std::string list_line(const NamedColorSpace& named) {
  std::string line =
      formatted("%-14s  %-50s  ", std::string(named.name).c_str(), components_text(named).c_str());
  line += std::string(named.description);
  if (has_curve(named)) line += "; curve " + curve_text(named.space.curve);
  return line + " (" + std::string(named.source) + ")\n";
}

std::string list_text() {
  std::string text;
  for (const NamedColorSpace& named : color_spaces()) text += list_line(named);
  return text +
         "hsv to yiq-1953 are those of rgb. Spaces with a curve take another: NAME:curve=srgb, bt709, "
         "bt1886,\n"
         "bt1886-1, linear or an exponent; the BT.1886 curves also black=LIGHT, the light of black over "
         "white's.\n";
}

Json json_of(const NamedColorSpace& named) {
  Json json{{"name", named.name}, {"components", Json::array()}};
  for (const auto& [name, unit, min, max] : named.components)
    json["components"].push_back({{"name", name}, {"unit", unit}, {"min", min}, {"max", max}});
  if (has_curve(named)) json["curve"] = curve_text(named.space.curve);
  json["description"] = named.description;
  json["source"] = named.source;
  return json;
}

std::string list_json() {
  Json json{{"spaces", Json::array()}};
  for (const NamedColorSpace& named : color_spaces()) json["spaces"].push_back(json_of(named));
  return json.dump(2) + "\n";
}

}  // namespace

std::string colors_text(const ColorRequest& request) {
  if (request.list) return request.json ? list_json() : list_text();
  const NamedColorSpace &from = request.from, &to = *request.to;
  const std::vector<ColorValues> colors = request.given ? *request.given : read_colors(std::cin, from);
  std::string text;
  Json json{{"from", from.name}, {"to", to.name}, {"colors", Json::array()}};
  for (const ColorValues& color : colors) {
    const ColorValues converted = convert_color(color, from.space, to.space);
    if (request.json) json["colors"].push_back({{"from", color}, {"to", converted}});
    else text += color_text(converted) + "\n";
  }
  return request.json ? json.dump(2) + "\n" : text;
}

}  // namespace tessera::program::cli
