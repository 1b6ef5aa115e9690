// Describes the build and the machine.
#pragma once

#include <string>

namespace tessera::program::cli {

/// Returns one line "name   value" for each of version, compiler, processor, cores, caches and instruction
/// sets.
std::string machine_text();

}  // namespace tessera::program::cli
