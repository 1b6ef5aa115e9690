// Completion scripts for shells. They complete commands, options, values, and names of workloads, files and
// folders, also those with spaces.
#pragma once

#include <string>
#include <vector>

#include "engine/program/cli/command_docs.h"

namespace tessera::program::cli {

std::string bash_completion(const std::vector<CommandDoc>& commands);
std::string zsh_completion(const std::vector<CommandDoc>& commands);
std::string fish_completion(const std::vector<CommandDoc>& commands);

/// @param shell  "bash", "zsh" or "fish"
std::string completion_script(const std::string& shell, const std::vector<CommandDoc>& commands);

}  // namespace tessera::program::cli
