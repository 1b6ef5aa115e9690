#include "engine/program/cli/file_guard.h"

#include <filesystem>
#include <system_error>

#include "engine/tessera/tessera.hpp"

namespace tessera::program::cli {

void refuse_overwriting(const std::string& picture, const std::string& input, const std::string& reference) {
  const auto refuse_if_same = [&](const std::string& named, const char* role) {
    std::error_code not_found;
    if (!named.empty() && std::filesystem::equivalent(picture, named, not_found))
      throw Error("the picture \"" + picture + "\" would overwrite the " + role + " \"" + named +
                  "\"; name another file with -o");
  };
  refuse_if_same(input, "input");
  refuse_if_same(reference, "reference");
}

}  // namespace tessera::program::cli
