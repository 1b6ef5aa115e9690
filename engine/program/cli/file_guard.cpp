#include "engine/program/cli/file_guard.h"

#include <filesystem>
#include <system_error>

#include "engine/tessera/tessera.hpp"

namespace tessera::program::cli {

void refuse_overwriting(const std::string& picture, const std::string& read, const std::string& role,
                        const std::string& option) {
  std::error_code not_found;
  if (!read.empty() && std::filesystem::equivalent(picture, read, not_found))
    throw Error("the picture \"" + picture + "\" would overwrite the " + role + " \"" + read +
                "\"; name another file with " + option);
}

}  // namespace tessera::program::cli
