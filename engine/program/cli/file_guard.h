// Keeps pictures from overwriting the files that the same command line names as input.
#pragma once

#include <string>

namespace tessera::program::cli {

/// Two paths name the same file if they lead to the same inode; a path that does not exist matches nothing.
/// @param input, reference  the scene or model, and the picture of --compare; empty: none
/// @throws Error, naming both paths, if `picture` is the input or the reference.
void refuse_overwriting(const std::string& picture, const std::string& input, const std::string& reference);

}  // namespace tessera::program::cli
