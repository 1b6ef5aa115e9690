// The manual page, as roff with the macros of man(7).
#pragma once

#include <string>
#include <vector>

#include "engine/program/cli/command_docs.h"

namespace tessera::program::cli {

/// Returns the manual page tessera(1).
std::string manual_page(const std::vector<CommandDoc>& commands, const std::string& version);

}  // namespace tessera::program::cli
