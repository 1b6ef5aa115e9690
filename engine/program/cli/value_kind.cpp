#include "engine/program/cli/value_kind.h"

#include <sstream>
#include <string_view>

#include "engine/program/cli/color_space_choice.h"
#include "engine/program/scene/dither_names.h"
#include "engine/tessera/display_mode.hpp"
#include "framebuffer/tessera/color.hpp"
#include "framebuffer/tessera/display.hpp"

namespace tessera::program::cli {
namespace {

using Source = ValueKind::Source;

/// The word of a placeholder: "MODE" of "[MODE,...]", "DISPLAY" of "DISPLAY[:KEY=VALUE,...]".
std::string placeholder_of(std::string_view value) {
  if (value.starts_with('[')) value.remove_prefix(1);
  return std::string(value.substr(0, value.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZ")));
}

/// Alternatives such as "flat|gouraud|phong"; of "none|COLOR" the word.
std::vector<std::string> alternatives(const std::string& value) {
  std::vector<std::string> list;
  std::istringstream stream(value);
  for (std::string word; std::getline(stream, word, '|');)
    if (placeholder_of(word) != word) list.push_back(word);
  return list;
}

std::vector<std::string> mode_names() {
  std::vector<std::string> names;
  for (const DisplayMode& mode : display_modes()) names.push_back(mode.name);
  return names;
}

std::vector<std::string> display_names() {
  std::vector<std::string> names;
  for (const NamedDisplayKind& kind : display_kinds()) names.emplace_back(kind.name);
  for (const DisplayPreset& preset : display_presets()) names.emplace_back(preset.name);
  return names;
}

std::vector<std::string> space_names() {
  std::vector<std::string> names;
  for (const NamedColorSpace& space : color_spaces()) names.emplace_back(space.name);
  return names;
}

std::vector<std::string> dither_names() {
  std::vector<std::string> names;
  for (const auto& [name, dither] : kDithers) names.emplace_back(name);
  return names;
}

std::vector<std::string> names_of(const std::vector<CommandDoc>& commands) {
  std::vector<std::string> names;
  for (const CommandDoc& command : commands) names.push_back(command.name);
  return names;
}

ValueKind kind_of_placeholder(const std::string& word, const std::vector<CommandDoc>& commands) {
  if (word == "MODE") return {Source::choices, mode_names()};
  if (word == "DISPLAY") return {Source::choices, display_names()};
  if (word == "SPACE") return {Source::choices, space_names()};
  if (word == "DITHER") return {Source::choices, dither_names()};
  if (word == "COMMAND") return {Source::choices, names_of(commands)};
  if (word == "WORKLOAD") return {Source::listed, {}, "tessera bench --list"};
  if (word == "PRICE") return {Source::listed, {}, "tessera price --list"};
  if (word == "DIR") return {Source::folders};
  const bool is_file = word == "FILE" || word == "PICTURE" || word == "SCENE" || word == "MODEL";
  return {is_file ? Source::files : Source::text};
}

}  // namespace

ValueKind value_kind(const OptionDoc& option, const std::vector<CommandDoc>& commands) {
  const std::string value = plain_value(option);
  const bool has_alternatives = value.find('|') != std::string::npos && value.find(' ') == std::string::npos;
  if (has_alternatives) return {Source::choices, alternatives(value)};
  const std::string word = placeholder_of(value);
  ValueKind kind = kind_of_placeholder(word, commands);
  kind.is_list = value.find(word + ",...") != std::string::npos;
  return kind;
}

}  // namespace tessera::program::cli
