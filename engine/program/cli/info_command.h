// `tessera info` and `tessera formats`: what this machine and this build can do.
#pragma once

#include <string>

namespace tessera::program::cli {

std::string info_text();
std::string formats_text();

}  // namespace tessera::program::cli
