// `tessera info` and `tessera formats`: what this machine and this build can do.
#pragma once

#include <string>

namespace tessera::cli {

/// Lines of what a picture might depend on, and must not.
std::string machine_text();
std::string info_text();
std::string formats_text();

}  // namespace tessera::cli
