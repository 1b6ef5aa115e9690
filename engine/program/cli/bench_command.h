// Commands that other programs of the package execute: `tessera bench`, `price` and `accuracy`.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/program/cli/command_docs.h"

namespace tessera::program::cli {

/// Replaces this process by the program of a command: tessera-bench or tessera-accuracy.
/// @param command  "bench", "price" or "accuracy"
/// @throws Error if the program is not next to this one or in ../libexec/tessera
void exec_measurement(const std::string& command, const std::vector<std::string>& arguments);

/// Describes the options of such a command, as its program knows them. Absent for other commands, and if the
/// program is not installed.
std::optional<CommandDoc> measurement_doc(const std::string& command);

}  // namespace tessera::program::cli
