#include "engine/program/cli/given_options.h"

#include <algorithm>

#include <CLI/CLI.hpp>

namespace tessera::program::cli {

GivenOptions::GivenOptions(const CLI::App& command) {
  for (const CLI::Option* option : command.get_options()) {
    if (option->count() == 0) continue;
    const bool is_operand = option->get_lnames().empty() && option->get_snames().empty();
    names_.insert(is_operand ? option->get_name(true) : option->get_name(false));
  }
}

void GivenOptions::require(std::initializer_list<OptionNeed> needs) const {
  for (const OptionNeed& need : needs)
    if (!need.is_met && has(need.option))
      throw UsageError(std::string(need.option) + ": " + std::string(need.needed));
}

void GivenOptions::allow_only(std::initializer_list<std::string_view> allowed,
                              std::string_view reason) const {
  for (const std::string& name : names_)
    if (std::find(allowed.begin(), allowed.end(), name) == allowed.end())
      throw UsageError(name + ": " + std::string(reason));
}

}  // namespace tessera::program::cli
