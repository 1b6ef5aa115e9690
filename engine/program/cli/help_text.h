// Help, wrapped to the width of the terminal.
#pragma once

#include <span>
#include <string>

#include "engine/program/cli/command_docs.h"

namespace tessera::program::cli {

/// Columns for help: those of the variable COLUMNS, else of the terminal on the standard output, else 80; at
/// least 40.
int help_columns();

/// Help of a command: usage, description, operands, options, examples. No line has more than `columns`
/// columns, except where a single word is longer.
/// @param program  "tessera render"
std::string command_help(const CommandDoc& command, const std::string& program, int columns);
/// Help of a program with commands.
/// @param whole  the program's own options and examples
std::string program_help(const CommandDoc& whole, std::span<const CommandDoc> commands, int columns);

}  // namespace tessera::program::cli
