#include "engine/program/cli/display_request.h"

#include <algorithm>
#include <vector>

#include "engine/program/cli/parse_overrides.h"
#include "engine/program/scene/suggest.h"
#include "engine/tessera/types.hpp"

namespace tessera::program::cli {
namespace {

using Names = std::vector<std::string_view>;

bool has(const Names& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// A suggestion for the first unknown name in the text of a display; empty: none.
std::string suggestion_for(std::string_view text) {
  const std::string_view name = text.substr(0, text.find(':'));
  Names names;
  for (const NamedDisplayKind& kind : display_kinds()) names.push_back(kind.name);
  for (const DisplayPreset& preset : display_presets()) names.push_back(preset.name);
  if (!has(names, name)) return did_you_mean(name, names);
  const std::vector<DisplayParameter> parameters = display_parameters(find_display(name).kind);
  Names keys;
  for (const DisplayParameter& parameter : parameters) keys.push_back(parameter.name);
  for (std::size_t at = name.size(); at < text.size(); at = std::min(text.find(',', at + 1), text.size())) {
    const std::string_view entry = text.substr(at + 1);
    const std::string_view key = entry.substr(0, entry.find_first_of("=,"));
    if (!has(keys, key)) return did_you_mean(key, keys);
  }
  return "";
}

}  // namespace

Display named_display(const std::string& text) {
  try {
    return find_display(text);
  } catch (const DisplayError& error) {
    throw Error(error.what() + suggestion_for(text));
  }
}

void parse_part(const std::string& text, ScreenView& view) {
  const std::vector<double> part = parse_numbers(text, 4, 4);
  if (part.empty() || part[0] < 0 || part[1] < 0 || part[2] <= 0 || part[3] <= 0)
    throw Error("found \"" + text +
                "\", expected X,Y,W,H in millimetres: the upper left corner, at least 0, and a size above 0");
  view.x_mm = part[0];
  view.y_mm = part[1];
  view.width_mm = part[2];
  view.height_mm = part[3];
}

}  // namespace tessera::program::cli
