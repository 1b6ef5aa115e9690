// All the files that code under test can read: read_text_file and import_model are replaced by ones that look
// here, and nowhere else.
#pragma once

#include <map>
#include <string>

namespace tessera::fuzz {

/// Bytes by path.
extern std::map<std::string, std::string, std::less<>> files;

}  // namespace tessera::fuzz
