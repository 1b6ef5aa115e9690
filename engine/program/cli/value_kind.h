// How shells complete the value of an option or an operand.
#pragma once

#include <string>
#include <vector>

#include "engine/program/cli/command_docs.h"

namespace tessera::program::cli {

struct ValueKind {
  enum class Source {
    text,     ///< nothing is proposed
    choices,  ///< one of `choices`
    listed,   ///< a word that `command` prints
    files,
    folders,
  };
  Source source = Source::text;
  std::vector<std::string> choices{};
  std::string command{};  ///< shell command; the first word of each line is a choice
  bool is_list = false;   ///< several choices, separated by commas
};

/// The kind follows from the placeholder: "a|b" are choices, FILE, DIR, MODE, WORKLOAD and the like have one
/// meaning in all commands.
/// @param commands  names of all commands, for COMMAND
ValueKind value_kind(const OptionDoc& option, const std::vector<CommandDoc>& commands);

}  // namespace tessera::program::cli
