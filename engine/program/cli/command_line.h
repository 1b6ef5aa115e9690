// Parses command lines: the program `tessera` and those that it executes for some commands share it.
#pragma once

#include <optional>
#include <string>

#include "engine/program/cli/exit_codes.h"
#include "engine/program/cli/usage_error.h"

namespace CLI {
class App;
}

namespace tessera::program::cli {

/// Sets how help is printed. Before options and commands are added, because commands copy it.
void set_help(CLI::App& program);

/// Help of the program or of one of its commands, as wide as the terminal. CLI::App::help() of a program is
/// that of the command which was parsed.
std::string help_of(const CLI::App& app);

/// Parses the arguments; prints help or version if they ask for it.
/// - `--describe`, which help does not show, prints doc_json() of a program without commands.
/// @return the exit code if nothing more is to be done
/// @throws UsageError
std::optional<int> parse_arguments(CLI::App& program, int count, char** arguments);

/// Message for a word that is no command, with a suggestion.
std::string unknown_command(const std::string& word, const CLI::App& program);

/// Prints "NAME: error: MESSAGE (see HELP --help)" on stderr. Returns kBadUsage.
int report_usage(const std::string& name, const std::string& message, const std::string& help);

}  // namespace tessera::program::cli
