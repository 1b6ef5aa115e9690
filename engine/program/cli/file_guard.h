// Keeps pictures from overwriting the files that the same command line names as input.
#pragma once

#include <string>

namespace tessera::program::cli {

/// Two paths name the same file if they lead to the same inode; a path that does not exist matches nothing.
/// @param read    a file that the command reads; empty: none
/// @param role    its role in the message: "input"
/// @param option  the option that names `picture`: "-o"
/// @throws Error, naming both paths, if they name the same file.
void refuse_overwriting(const std::string& picture, const std::string& read, const std::string& role,
                        const std::string& option);

}  // namespace tessera::program::cli
