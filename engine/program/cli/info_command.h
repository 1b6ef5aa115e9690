// `tessera info` and `tessera formats`: describe the machine and the supported file formats.
#pragma once

#include <string>

namespace tessera::program::cli {

std::string info_text();
std::string formats_text();

}  // namespace tessera::program::cli
