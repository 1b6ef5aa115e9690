// The standard output, of which nothing may be lost without a word.
#pragma once

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <iostream>
#include <string>
#include <string_view>

#include "engine/tessera/tessera.hpp"

namespace tessera::program::cli {

/// Hands a text over at once. @throws Error where that fails, for want of room on a disk, say
inline void write_to_stdout(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0)
    throw Error(std::string("cannot write to the standard output: ") + std::strerror(errno));
}

/// Hands over what is still waiting in std::cout and stdio. @throws Error where that fails, or where
/// something was lost before: the reason of that is not known any more
inline void require_stdout_written() {
  write_to_stdout("");
  if (std::ferror(stdout) != 0 || !std::cout) throw Error("cannot write to the standard output");
}

}  // namespace tessera::program::cli
