// In-memory files: replaces read_text_file() and import_model(), so that the code under test reads no others.
#pragma once

#include <map>
#include <string>

namespace tessera::fuzz {

/// Contents by path.
extern std::map<std::string, std::string, std::less<>> files;

}  // namespace tessera::fuzz
