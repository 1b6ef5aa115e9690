#include "engine/program/cli/output_folder.h"

#include <filesystem>
#include <system_error>

#include "engine/program/imageio/atomic_file.h"
#include "engine/tessera/types.hpp"

namespace tessera::program::cli {

void prepare_folder(const std::string& folder, const std::string& file) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw Error("cannot make the folder \"" + folder + "\": " + error.message());
  require_writable((std::filesystem::path(folder) / file).string());
}

}  // namespace tessera::program::cli
