// The end of what a program says.
#pragma once

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <iostream>
#include <string>

#include "engine/tessera/tessera.hpp"

namespace tessera::cli {

/// Sends what is still waiting. All that was said has to have got through: a program that was asked for a text and could not give it has failed.
/// @throws Error where some has not, for want of room on a disk, say
inline void require_stdout_written() {
  errno = 0;  // what failed earlier has left its mark, but not its reason
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0 && std::cout.good()) return;
  throw Error(std::string("cannot write to the standard output") + (errno != 0 ? std::string(": ") + std::strerror(errno) : ""));
}

}  // namespace tessera::cli
