// A whole file as text.
#pragma once

#include <string>

namespace tessera {

/// @throws Error, naming the file and the reason, for one that is missing, is a folder, or cannot be read.
std::string read_text_file(const std::string& path);

}  // namespace tessera
