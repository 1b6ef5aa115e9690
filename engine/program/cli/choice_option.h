// Options that take one of several names, or a text with a parser.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/program/cli/validators.h"
#include "engine/tessera/types.hpp"

namespace tessera::program::cli {

template <class Enum>
struct Choice {
  std::string_view name;
  Enum value;
};

/// Adds an option that takes the name of one of `choices`.
template <class Target, class Enum>
void add_choice(CLI::App& command, const std::string& option, Target& target,
                const std::vector<Choice<Enum>>& choices, const std::string& text) {
  Names names;
  std::string value_text;
  for (const Choice<Enum>& choice : choices) {
    names.push_back(choice.name);
    value_text += (value_text.empty() ? "" : "|") + std::string(choice.name);
  }
  const auto set = [&target, choices](const std::string& typed) {
    for (const Choice<Enum>& choice : choices)
      if (choice.name == typed) target = choice.value;
  };
  command.add_option_function<std::string>(option, set, text)->option_text(value_text)->check(one_of(names));
}

/// Adds an option whose text goes to take(text). An Error of `take` becomes a usage error.
template <class Take>
CLI::Option* add_text(CLI::App& command, const std::string& option, const Take& take,
                      const std::string& text) {
  const auto set = [option, take](const std::string& typed) {
    try {
      take(typed);
    } catch (const Error& error) {
      throw CLI::ValidationError(option, error.what());
    }
  };
  return command.add_option_function<std::string>(option, set, text);
}

/// Adds an option whose text becomes `target` = parse(text). An Error of `parse` becomes a usage error.
template <class Target, class Parse>
CLI::Option* add_parsed(CLI::App& command, const std::string& option, Target& target, const Parse& parse,
                        const std::string& text) {
  return add_text(
      command, option, [&target, parse](const std::string& typed) { target = parse(typed); }, text);
}

}  // namespace tessera::program::cli
