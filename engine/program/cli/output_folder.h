// Folders that receive the files of a comparison.
#pragma once

#include <string>

namespace tessera::program::cli {

/// Creates the folder if it does not exist.
/// @param file  one of the files that will be written into it
/// @throws Error if they cannot be written
void prepare_folder(const std::string& folder, const std::string& file);

}  // namespace tessera::program::cli
