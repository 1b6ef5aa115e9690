// What a picture might depend on, and must not; and what the time that it takes depends on.
#pragma once

#include <string>

namespace tessera::program::cli {

/// Version, compiler, processor, cores, caches and instruction sets: a line each, of a name and what it is.
std::string machine_text();

}  // namespace tessera::program::cli
